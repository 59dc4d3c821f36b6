/* The front of a collapsing column, after J. C. Martin and W. J. Moyce, "An experimental study of the
   collapse of liquid columns on a rigid horizontal plane", 1952; and of that column without friction, as
   boundary elements have it (tests/app/test_dam_break_potential.c), which runs ahead of the experiment's by
   14 %. */
#include "app/case/all.h"
#include "app/case/reference.h"
#include "app/metric/metric.h"

#include <math.h>

enum { FRONT, HEIGHT };

/* The column's width a, its left side on the wall. */
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

/* |Z(T_k) - Z_k| / Z_k over the rows of a reference, T = t sqrt(2 g / a), Z = x / a, or the same of H = y /
   a; no shift in time. Its points go to curve `c` of the plot. */
static bool compare(CaseRun *run, const char *path, int what, int c, double *mean, double *worst,
                    Error *error)
{
    static Reference reference;
    if (!reference_load(path, &reference, error))
        return false;
    *mean = *worst = 0;
    for (int k = 0; k < reference.rows; k++) {
        const double t = reference_number(&reference, k, "T"),
                     z = reference_number(&reference, k, names[what]);
        const double miss = fabs(curve_at(&run->found[what], t) - z) / z;
        curve_add(&run->expected[c], t, z);
        *mean += miss / reference.rows;
        *worst = figure_worse(*worst, miss);
    }
    return true;
}

static bool judge(CaseRun *run, Error *error)
{
    const double a = width_of(run->def), scale = sqrt(-2 * run->def->gravity[1] / a);
    static const char potential[] = "scenes/reference/dam-break-potential.csv";
    double mean[3], worst[3];
    for (int what = FRONT; what <= HEIGHT; what++)
        for (size_t i = 0; i < run->column[what].count; i++)
            curve_add(&run->found[what], run->column[what].at[i][0] * scale, run->column[what].at[i][1] / a);
    if (!compare(run, "scenes/reference/martin-moyce-1952.csv", FRONT, 0, &mean[0], &worst[0], error) ||
        !compare(run, potential, FRONT, 1, &mean[1], &worst[1], error) ||
        !compare(run, potential, HEIGHT, 2, &mean[2], &worst[2], error))
        return false;
    run->figures[0] = figure_scaled(mean[1], 0, 1);
    run->figures[1] = figure_scaled(mean[0], 0, 1);
    run->figures[2] = figure_scaled(worst[0], 0, 1);
    run->figures[3] = figure_scaled(mean[2], 0, 1);
    return true;
}

/* The coarse set judges by what a fluid without friction misses the experiment by
   (tests/app/test_dam_break_potential.c): less than that is the solver's own friction. How near it is to that
   fluid is the first figure, which a chart goes by. */
#define COMMON                                                                                               \
    .methods = {{.name = "wcsph"},                                                                           \
                {.name = "dfsph", .tolerance = {0.02, 0.14, 0.22, 0.025}, .coarse = {0.045, [3] = 0.045}},   \
                {.name = "mueller", .tolerance = {0.025, 0.14, 0.21, 0.09}, .coarse = {0.05, [3] = 0.1}},    \
                {.name = "pbf",                                                                              \
                 .set = {"solver.step.dt=0.002"},                                                            \
                 .tolerance = {0.03, 0.14, 0.21},                                                            \
                 .coarse = {0.05, 0.15, 0.23}}},                                                             \
    .time = 0.184, .every = 0.0005, /* T = 3.41 */                                                           \
        .metrics = {{"off potential flow, mean", "", .tolerance = 0.03, .coarse = 0.04},                     \
                    {"front, mean error", "", .tolerance = 0.025, .coarse = 0.14},                           \
                    {"front, worst error", "", .tolerance = 0.05, .coarse = 0.21},                           \
                    {"column off potential flow, mean", "", .tolerance = 0.02, .coarse = 0.03}},             \
    .plot = {.x = "T = t sqrt(2 g / a)",                                                                     \
             .y = "front Z = x / a, column H = y / a",                                                       \
             .found = {"front", "column"},                                                                   \
             .expected = {"Martin and Moyce 1952", "potential flow", "its column"},                          \
             .points = true},                                                                                \
    .sample = sample, .judge = judge

const Case case_dam_break = {
    .name = "dam_break",
    .help = "a collapsing column's front, Martin and Moyce 1952",
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
