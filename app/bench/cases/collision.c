/* Two drops collide off centre: momenta are conserved, and energy must not grow. */
#include "app/bench/cases/case_list.h"
#include "app/run/measure/measure.h"

#include <math.h>

enum { ENERGY, MOMENTUM_X, MOMENTUM_Y, SPIN };

/* Per particle mass: both drops have the same density. */
static void sample(CaseRun *run)
{
    Energies e;
    double sum[3] = {0};
    metric_energies(&run->cloud, run->def, &e);
    for (size_t i = 0; i < run->cloud.count; i++) {
        const float *x = run->cloud.position + 4 * i, *v = run->cloud.velocity + 4 * i;
        sum[0] += v[0];
        sum[1] += v[1];
        sum[2] += (double)x[0] * v[1] - (double)x[1] * v[0];
    }
    curve_add(&run->column[ENERGY], run->info.time, e.kinetic + e.elastic);
    for (int k = 0; k < 3; k++)
        curve_add(&run->column[MOMENTUM_X + k], run->info.time, sum[k]);
}

static double most_change(const Curve *curve)
{
    double most = 0;
    for (size_t i = 0; i < curve->count; i++)
        most = figure_worse(most, fabs(curve->at[i][1] - curve->at[0][1]));
    return most;
}

static bool judge(CaseRun *run, Error *error)
{
    (void)error;
    const Curve *energy = &run->column[ENERGY];
    const double speed = fabs(run->def->fluids[0].velocity[0]), scale = speed * (double)run->cloud.count;
    const double reach = run->def->fluids[0].fills[0].radius;
    double gained = 0;
    for (size_t i = 0; i < energy->count; i++) {
        gained = figure_worse(gained, energy->at[i][1] - energy->at[0][1]);
        curve_add(&run->found[0], energy->at[i][0], energy->at[i][1] / energy->at[0][1]);
        curve_add(&run->expected[0], energy->at[i][0], 1);
    }
    const double momentum =
        hypot(most_change(&run->column[MOMENTUM_X]), most_change(&run->column[MOMENTUM_Y]));
    run->figures[0] = figure_scaled(momentum / scale, 0, 1);
    run->figures[1] = figure_scaled(most_change(&run->column[SPIN]) / (scale * reach), 0, 1);
    run->figures[2] = figure_scaled(gained / energy->at[0][1], 0, 1);
    return true;
}

const Case case_collision = {
    .name = "collision",
    .help = "two drops that collide off centre: momenta and energy",
    .scene = "scenes/cases/collision.yaml",
    .methods = {{.name = "wcsph"},
                {.name = "mueller"},
                {.name = "dfsph"},
                {.name = "pbf", .tolerance = {0.01, 0.09, 0.01}, .coarse = {0.01, 0.09, 0.01}}},
    .spacing = {0.05, 0.025, 0.0125},
    .time = 1.5,
    .every = 0.01,
    .metrics = {{"momentum changed", "", .tolerance = 1e-4, .coarse = 1e-4},
                {"angular momentum changed", "", .tolerance = 1e-3, .coarse = 1e-3},
                {"energy gained", "", .tolerance = 0.01, .coarse = 0.01}},
    .plot = {.x = "time, s",
             .y = "kinetic energy and that of compression, over the start's",
             .found = {"energy"},
             .expected = {"the most there may be"}},
    .sample = sample,
    .judge = judge,
};
