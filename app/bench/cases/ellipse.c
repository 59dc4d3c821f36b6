/* A drop of inviscid fluid stretched by a flow u = -A x, v = A y: the drop stays an ellipse; J. J.
   Monaghan, "Simulating free surface flows with SPH", 1994. The only force is pressure, 0 on the ellipse.
   The semi-axes a along x and b = 1 / a along y follow A' = A^2 (a^4 - 1) / (a^4 + 1), a' = -a A. */
#include "app/bench/cases/case_list.h"
#include "app/run/measure/measure.h"
#include "sim/step/method.h"

#include <math.h>

enum { SHORT, LONG };

static const double RATE = 100; /* A at the start, 1/s */

/* Starts with the pressure rho A^2 (R^2 - r^2) / 2 of the exact flow, and the corresponding compression.
   Without this pressure the drop would expand until sound has crossed the drop. */
static void start(const WorldDef *def, CaseStart *state)
{
    const double *centre = def->fluids[0].fills[0].centre, radius = def->fluids[0].fills[0].radius;
    const bool pressed = !method_find(def->method)->incompressible;
    const double press = pressed ? 0.5 * pow(RATE / def->sound_speed, 2) : 0;
    for (size_t i = 0; i < state->count; i++) {
        float *x = state->position + 3 * i;
        const double r2 = pow(x[0] - centre[0], 2) + pow(x[1] - centre[1], 2), most2 = radius * radius;
        const double inward = press * (0.5 * most2 - 0.25 * r2);
        state->velocity[3 * i] = (float)(-RATE * (x[0] - centre[0]));
        state->velocity[3 * i + 1] = (float)(RATE * (x[1] - centre[1]));
        state->density[i] *= (float)(1 + press * (most2 - r2));
        for (int k = 0; k < 2; k++)
            x[k] -= (float)(inward * (x[k] - centre[k]));
    }
}

static void sample(CaseRun *run)
{
    double axes[2];
    metric_axes(&run->cloud, axes);
    curve_add(&run->column[SHORT], run->info.time, axes[0]);
    curve_add(&run->column[LONG], run->info.time, axes[1]);
}

/* Advances a and A by dt with the classical Runge-Kutta method. */
static void ellipse_step(double state[2], double dt)
{
    double k[4][2], sum[2];
    for (int s = 0; s < 4; s++) {
        const double part = s == 0 ? 0 : s < 3 ? 0.5 * dt : dt;
        const double a = state[0] + (s ? part * k[s - 1][0] : 0),
                     rate = state[1] + (s ? part * k[s - 1][1] : 0);
        const double a4 = a * a * a * a;
        k[s][0] = -a * rate;
        k[s][1] = rate * rate * (a4 - 1) / (a4 + 1);
    }
    for (int n = 0; n < 2; n++)
        sum[n] = k[0][n] + 2 * k[1][n] + 2 * k[2][n] + k[3][n];
    for (int n = 0; n < 2; n++)
        state[n] += dt / 6 * sum[n];
}

static bool judge(CaseRun *run, Error *error)
{
    (void)error;
    enum { STEPS = 200 };
    const double radius = run->def->fluids[0].fills[0].radius;
    double state[2] = {1, RATE};
    for (int i = 0; i <= STEPS; i++) {
        const double t = run->info.time * i / STEPS;
        curve_add(&run->expected[0], t, radius * state[0]);
        curve_add(&run->expected[1], t, radius / state[0]);
        if (i < STEPS)
            ellipse_step(state, run->info.time / STEPS);
    }
    for (int k = SHORT; k <= LONG; k++) {
        const Curve *found = &run->column[k];
        for (size_t i = 0; i < found->count; i++)
            curve_add(&run->found[k], found->at[i][0], found->at[i][1]);
    }
    run->figures[0] =
        figure_relative(run->column[SHORT].at[run->column[SHORT].count - 1][1], radius * state[0]);
    run->figures[1] =
        figure_relative(run->column[LONG].at[run->column[LONG].count - 1][1], radius / state[0]);
    return true;
}

const Case case_ellipse = {
    .name = "elliptical_drop",
    .help = "a drop drawn out into an ellipse, Monaghan 1994",
    .scene = "scenes/cases/elliptical_drop.yaml",
    .methods = {{.name = "wcsph"},
                {.name = "mueller", .tolerance = {0.05}, .coarse = {0.12}},
                {.name = "dfsph", .set = {"particles.support=3.5"}},
                {.name = "pbf", .left_out = "all of it takes half a step of 1/60 s"}},
    .spacing = {0.05, 0.02, 0.01},
    .time = 0.0076,
    .every = 0.0001,
    .metrics = {{"short axis", "m", .tolerance = 0.02, .coarse = 0.04},
                {"long axis", "m", .tolerance = 0.02, .coarse = 0.04}},
    .plot = {.x = "time, s",
             .y = "semi-axis, m",
             .found = {"short axis", "long axis"},
             .expected = {"exact", "exact"}},
    .start = start,
    .sample = sample,
    .judge = judge,
};
