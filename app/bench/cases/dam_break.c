/* Front and height of a collapsing column without friction, compared with boundary elements
   (tests/app/test_dam_break_potential.c). The experiment of J. C. Martin and W. J. Moyce, "An experimental
   study of the collapse of liquid columns on a rigid horizontal plane", 1952, is shown beside. The exact
   front is 14 % ahead of the experiment, so a solver without friction should miss the experiment by as
   much. */
#include "app/bench/cases/case.h"
#include "app/bench/cases/case_list.h"
#include "app/run/measure/measure.h"

#include <math.h>

enum { FRONT, HEIGHT };

/* Width a of the column, whose left side is at the wall. */
static double width_of(const WorldDef *def)
{
    const Fill *fill = &def->fluids[0].fills[0];
    return fill->max[0] - fill->min[0];
}

static void sample(CaseRun *run)
{
    const double half = 0.5 * run->def->box_size[0];
    curve_add(&run->column[FRONT], run->info.time, metric_front(&run->cloud) + half);
    curve_add(&run->column[HEIGHT], run->info.time, metric_wall_height(&run->cloud, -half));
}

static const char *const names[] = {[FRONT] = "Z", [HEIGHT] = "H"};

/* Reference curves of the plot. */
enum { EXPERIMENT, POTENTIAL_FRONT, POTENTIAL_HEIGHT };

/* Loads a reference as a curve: T = t sqrt(2 g / a), and Z = x / a or H = y / a. */
static bool expect(CaseRun *run, int c, const char *path, int what, Error *error)
{
    Reference reference;
    if (!reference_load(path, &reference, error))
        return false;
    for (int k = 0; k < reference.rows; k++)
        curve_add(&run->expected[c], reference_number(&reference, k, "T"),
                  reference_number(&reference, k, names[what]));
    return true;
}

typedef struct FrontError {
    double mean, worst;
} FrontError;

/* |found(T_k) - Z_k| / Z_k over the points of the reference; no shift in time. */
static FrontError miss_of(const Curve *found, const Curve *expected)
{
    FrontError miss = {0, 0};
    for (size_t k = 0; k < expected->count; k++) {
        const double z = expected->at[k][1], one = fabs(curve_at(found, expected->at[k][0]) - z) / z;
        miss.mean += one / (double)expected->count;
        miss.worst = figure_worse(miss.worst, one);
    }
    return miss;
}

static bool judge(CaseRun *run, Error *error)
{
    const double a = width_of(run->def), scale = sqrt(-2 * run->def->gravity[1] / a);
    static const char potential[] = "scenes/reference/dam-break-potential.csv";
    for (int what = FRONT; what <= HEIGHT; what++)
        for (size_t i = 0; i < run->column[what].count; i++)
            curve_add(&run->found[what], run->column[what].at[i][0] * scale, run->column[what].at[i][1] / a);
    if (!expect(run, EXPERIMENT, "scenes/reference/martin-moyce-1952.csv", FRONT, error) ||
        !expect(run, POTENTIAL_FRONT, potential, FRONT, error) ||
        !expect(run, POTENTIAL_HEIGHT, potential, HEIGHT, error))
        return false;
    const Curve *found = run->found, *expected = run->expected;
    const FrontError own = miss_of(&found[FRONT], &expected[EXPERIMENT]),
                     exact = miss_of(&expected[POTENTIAL_FRONT], &expected[EXPERIMENT]);
    run->figures[0] = figure_scaled(miss_of(&found[FRONT], &expected[POTENTIAL_FRONT]).mean, 0, 1);
    run->figures[1] = figure_scaled(miss_of(&found[HEIGHT], &expected[POTENTIAL_HEIGHT]).mean, 0, 1);
    run->figures[2] = figure_scaled(own.mean, exact.mean, 1);
    run->figures[3] = figure_scaled(own.worst, exact.worst, 1);
    return true;
}

#define COMMON                                                                                               \
    .methods = {{.name = "wcsph"},                                                                           \
                {.name = "dfsph", .tolerance = {0.02, 0.025}, .coarse = {0.045, 0.045}},                     \
                {.name = "mueller", .tolerance = {0.015, 0.015}, .coarse = {[1] = 0.025}},                   \
                {.name = "pbf", .set = {"solver.step.dt=0.002"}, .tolerance = {0.03}, .coarse = {0.05}}},    \
    .time = 0.184, .every = 0.0005, /* T = 3.41 */                                                           \
        .metrics = {{"front off potential flow", "", .tolerance = 0.015, .coarse = 0.04},                    \
                    {"column off potential flow", "", .tolerance = 0.02, .coarse = 0.03},                    \
                    {"front off experiment, mean", "", .no_verdict = true},                                  \
                    {"front off experiment, worst", "", .no_verdict = true}},                                \
    .plot = {.x = "T = t sqrt(2 g / a)",                                                                     \
             .y = "front Z = x / a, column H = y / a",                                                       \
             .found = {"front", "column"},                                                                   \
             .expected = {"Martin and Moyce 1952", "potential flow", "its column"},                          \
             .points = true},                                                                                \
    .sample = sample, .judge = judge

const Case case_dam_break = {
    .name = "dam_break",
    .help = "a collapsing column: its front and height by potential flow",
    .scene = "scenes/cases/dam_break.yaml",
    .spacing = {0.05715 / 10, 0.05715 / 20, 0.05715 / 40},
    COMMON,
};

const Case case_dam_break_2d = {
    .name = "dam_break_2d",
    .help = "the same in the plane",
    .scene = "scenes/cases/dam_break_2d.yaml",
    .spacing = {0.05715 / 20, 0.05715 / 69, 0.05715 / 138},
    COMMON,
};
