/* A spinning bucket: the surface is y = omega^2 r^2 / 2 g. */
#include "app/bench/cases/case_list.h"
#include "app/run/measure/measure.h"

#include <math.h>

enum { SLOPE };

static void sample(CaseRun *run)
{
    curve_add(&run->column[SLOPE], run->info.time,
              metric_paraboloid(&run->cloud, run->def->box_size[0], NULL));
}

/* Takes the mean over the last third of the time, as remaining sloshing rotates. */
static bool judge(CaseRun *run, Error *error)
{
    (void)error;
    const double omega = run->def->motions[0].rate, right = omega * omega / (-2 * run->def->gravity[1]);
    const Curve *slope = &run->column[SLOPE];
    double mean = 0, count = 0, top = 0;
    for (size_t i = 0; i < slope->count; i++)
        if (slope->at[i][0] > run->info.time * 2 / 3) {
            mean += slope->at[i][1];
            count++;
        }
    run->figures[0] = figure_relative(mean / count, right);
    metric_paraboloid(&run->cloud, run->def->box_size[0], &run->found[0]);
    for (size_t i = 0; i < run->found[0].count; i++) {
        const double r = run->found[0].at[i][0];
        top += (run->found[0].at[i][1] - right * r * r) / (double)run->found[0].count;
    }
    for (int i = 0; i <= 35; i++) {
        const double r = 0.02 * i * run->def->box_size[0];
        curve_add(&run->expected[0], r, top + right * r * r);
    }
    return true;
}

const Case case_bucket = {
    .name = "bucket",
    .help = "a bucket that spins: the curvature of its surface",
    .scene = "scenes/cases/bucket.yaml",
    .methods = {{.name = "wcsph"},
                {.name = "mueller", .tolerance = {0.045}},
                {.name = "dfsph", .left_out = "400 Pa s set its steps, so that it takes as long as wcsph"},
                {.name = "pbf",
                 .left_out = "a step of 1/60 s stands a tenth of 400 Pa s, so that it spins another fluid"}},
    .spacing = {1.6 / 14, 0.04, 0.032},
    .time = 3.5,
    .every = 0.05,
    .metrics = {{"curvature", "1/m", .tolerance = 0.03, .coarse = 0.2}},
    .plot = {.x = "distance from the axis, m",
             .y = "height, m",
             .found = {"highest particles"},
             .expected = {"omega^2 r^2 / 2 g"},
             .dots = true},
    .sample = sample,
    .judge = judge,
};
