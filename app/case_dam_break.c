/* The front of a collapsing column, after J. C. Martin and W. J. Moyce, "An experimental study of the
   collapse of liquid columns on a rigid horizontal plane", 1952. */
#include "app/case_all.h"
#include "app/metric.h"
#include "app/reference.h"

#include <math.h>

enum { FRONT };

/* The column's width a, its left side on the wall. */
static double width_of(const WorldDef *def)
{
    const Fill *fill = &def->fluids[0].fills[0];
    return fill->max[0] - fill->min[0];
}

static void sample(CaseRun *run)
{
    curve_add(&run->column[FRONT], run->info.time, metric_front(&run->cloud) + 0.5 * run->def->box_size[0]);
}

/* |Z(T_k) - Z_k| / Z_k over the published points, T = t sqrt(2 g / a), Z = x / a; no shift in time. */
static bool judge(CaseRun *run, Error *error)
{
    static Reference published;
    const double a = width_of(run->def), scale = sqrt(-2 * run->def->gravity[1] / a);
    double mean = 0, worst = 0;
    if (!reference_load("scenes/reference/martin-moyce-1952.csv", &published, error))
        return false;
    for (size_t i = 0; i < run->column[FRONT].count; i++)
        curve_add(&run->found[0], run->column[FRONT].at[i][0] * scale, run->column[FRONT].at[i][1] / a);
    for (int k = 0; k < published.rows; k++) {
        const double t = reference_number(&published, k, "T"), z = reference_number(&published, k, "Z");
        const double miss = fabs(curve_at(&run->found[0], t) - z) / z;
        curve_add(&run->expected[0], t, z);
        mean += miss / published.rows;
        worst = figure_worse(worst, miss);
    }
    run->figures[0] = figure_scaled(mean, 0, 1);
    run->figures[1] = figure_scaled(worst, 0, 1);
    return true;
}

#define COMMON                                                                                               \
    .methods = {"wcsph"}, .time = 0.182, .every = 0.0005, /* T = 3.37 */                                     \
        .metrics = {{"front, mean error", "", .tolerance = 0.025, .coarse = 0.12},                           \
                    {"front, worst error", "", .tolerance = 0.05, .coarse = 0.2}},                           \
    .plot = {.x = "T = t sqrt(2 g / a)",                                                                     \
             .y = "front Z = x / a",                                                                         \
             .found = {"front"},                                                                             \
             .expected = {"Martin and Moyce 1952"},                                                          \
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
