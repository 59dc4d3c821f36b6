/* Linear sloshing: the box shakes for two periods, then the fluid oscillates at its natural frequency,
   omega^2 = g k tanh(k d), k = pi / L. */
#include "app/bench/cases/case_list.h"
#include "app/run/measure/measure.h"

#include <math.h>

enum { CENTRE };

static void sample(CaseRun *run)
{
    double centre[3];
    metric_centre(&run->cloud, -INFINITY, INFINITY, centre);
    curve_add(&run->column[CENTRE], run->info.time, centre[0]);
}

static bool judge(CaseRun *run, Error *error)
{
    (void)error;
    const WorldDef *def = run->def;
    const Fill *fill = &def->fluids[0].fills[0];
    const double k = M_PI / (fill->max[0] - fill->min[0]), depth = fill->max[1] - fill->min[1];
    const double omega = sqrt(-def->gravity[1] * k * tanh(k * depth));
    const double released = def->motions[0].start + def->motions[0].duration;
    Curve free = {.count = 0};
    for (size_t i = 0; i < run->column[CENTRE].count; i++) {
        const double *at = run->column[CENTRE].at[i];
        if (at[0] > released)
            curve_add(&free, at[0], at[1]);
        curve_add(&run->found[0], at[0], at[1]);
    }
    run->figures[0] = figure_relative(2 * M_PI / curve_period(&free), omega);
    /* expected curve: with the phase and amplitude of the simulation */
    double most = 0, a = 0, b = 0;
    for (size_t i = 0; i < free.count; i++) {
        a += free.at[i][1] * cos(omega * (free.at[i][0] - released));
        b += free.at[i][1] * sin(omega * (free.at[i][0] - released));
    }
    most = 2 * hypot(a, b) / (double)free.count;
    for (size_t i = 0; i < free.count; i++)
        curve_add(&run->expected[0], free.at[i][0],
                  most * cos(omega * (free.at[i][0] - released) - atan2(b, a)));
    curve_free(&free);
    return true;
}

const Case case_sloshing = {
    .name = "sloshing",
    .help = "linear sloshing, forced by the moving box: its natural frequency",
    .scene = "scenes/cases/sloshing.yaml",
    .methods = {{.name = "wcsph"},
                {.name = "mueller", .tolerance = {0.06}, .coarse = {0.17}},
                {.name = "dfsph", .tolerance = {0.015}, .coarse = {0.015}},
                {.name = "pbf",
                 .left_out =
                     "waves this low are lost in its tolerance of 1 %, and what period they have is chance"}},
    .spacing = {0.05, 0.025, 0.0125},
    .time = 10,
    .every = 0.02,
    .metrics = {{"frequency", "rad/s", .tolerance = 0.015, .coarse = 0.02, .without = "does not oscillate"}},
    .plot = {.x = "time, s",
             .y = "centre of mass, m",
             .found = {"centre"},
             .expected = {"linear theory, fitted in height and phase"}},
    .sample = sample,
    .judge = judge,
};
