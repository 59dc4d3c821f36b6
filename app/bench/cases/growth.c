/* A heavy fluid above a light fluid fill a box, with a growing wave between: Rayleigh-Taylor instability.
   The start is the growing eigenmode of linear theory, so that the whole wave grows at one rate. */
#include "app/bench/cases/case_list.h"

#include <math.h>

enum { WAVE };

static const double SLOPE = 0.02; /* k times the wave's height at the start */

/* Half a wave across the box, for inviscid, incompressible fluids: Lamb, Hydrodynamics, 231. In a fluid of
   depth d the velocity potential is +-height rate cosh(k d') / sinh(k d) / k cos(k x), d' measured from
   the fluid's end. */
typedef struct Growth {
    double k, rate, gravity; /* 1/m, 1/s, m/s2 */
    double left, middle;     /* x of the box's left side, y of the interface, m */
    double depth[2];         /* of the light and the heavy fluid, m */
    double density[2];       /* kg/m3 */
} Growth;

static Growth growth_of(const WorldDef *def)
{
    const FluidDef *light = &def->fluids[0], *heavy = &def->fluids[1];
    const Fill *below = &light->fills[0], *above = &heavy->fills[0];
    Growth g = {.k = M_PI / (below->max[0] - below->min[0]),
                .gravity = -def->gravity[1],
                .left = below->min[0],
                .middle = below->max[1],
                .depth = {below->max[1] - below->min[1], above->max[1] - above->min[1]},
                .density = {light->density, heavy->density}};
    g.rate = sqrt(g.gravity * g.k * (heavy->density - light->density) /
                  (light->density / tanh(g.k * g.depth[0]) + heavy->density / tanh(g.k * g.depth[1])));
    return g;
}

/* Displacement and pressure change at x for a wave of 1 m, per 1 m. The pressure, Pa, includes the flow's
   part and the part of the new height. */
static void wave_at(const Growth *g, int fluid, const double x[2], double moved[2], double *pressure)
{
    const double sign = fluid == 0 ? 1 : -1, depth = g->depth[fluid], along = g->k * (x[0] - g->left),
                 from = g->k * (depth - sign * (g->middle - x[1])), scale = 1 / sinh(g->k * depth);
    moved[0] = -sign * scale * cosh(from) * sin(along);
    moved[1] = scale * sinh(from) * cos(along);
    *pressure = -g->density[fluid] *
                (sign * g->rate * g->rate / g->k * scale * cosh(from) * cos(along) + g->gravity * moved[1]);
}

static void start(const WorldDef *def, CaseStart *state)
{
    const Growth g = growth_of(def);
    const double height = SLOPE / g.k, stiff = def->sound_speed * def->sound_speed;
    for (size_t i = 0; i < state->count; i++) {
        float *x = state->position + 3 * i;
        const double at[2] = {(double)x[0], (double)x[1]};
        double moved[2], pressure;
        wave_at(&g, state->fluid[i], at, moved, &pressure);
        for (int a = 0; a < 2; a++) {
            x[a] += (float)(height * moved[a]);
            state->velocity[3 * i + (size_t)a] = (float)(height * g.rate * moved[a]);
        }
        state->density[i] += (float)(height * pressure / stiff);
    }
}

/* Projects all velocities on the wave, m/s. */
static void sample(CaseRun *run)
{
    const Growth g = growth_of(run->def);
    const Cloud *cloud = &run->cloud;
    double product = 0, square = 0;
    for (size_t i = 0; i < cloud->count; i++) {
        const float *x = cloud->position + 4 * i, *v = cloud->velocity + 4 * i;
        const int fluid = (int)cloud->fluid[i];
        const double at[2] = {(double)x[0], (double)x[1]};
        double wave[2], pressure;
        wave_at(&g, fluid, at, wave, &pressure);
        product += g.density[fluid] * ((double)v[0] * wave[0] + (double)v[1] * wave[1]);
        square += g.density[fluid] * (wave[0] * wave[0] + wave[1] * wave[1]);
    }
    curve_add(&run->column[WAVE], run->info.time, log(fabs(product) / square * g.k / g.rate));
}

/* Compares the slope of ln(k height) over time while the wave is low. */
static bool judge(CaseRun *run, Error *error)
{
    (void)error;
    const Growth g = growth_of(run->def);
    const Curve *wave = &run->column[WAVE];
    for (size_t i = 0; i < wave->count; i++) {
        const double t = wave->at[i][0];
        if (g.rate * t > 2.3)
            break;
        curve_add(&run->found[0], t, wave->at[i][1]);
        curve_add(&run->expected[0], t, log(SLOPE) + g.rate * t);
    }
    run->figures[0] = figure_relative(curve_slope(&run->found[0]), g.rate);
    return true;
}

#define COMMON                                                                                               \
    .scene = "scenes/cases/growth.yaml", .spacing = {0.03125, 0.015625, 0.0078125}, .every = 0.01,           \
    .methods = {{.name = "wcsph"},                                                                           \
                {.name = "dfsph",                                                                            \
                 .set = {"solver.divergence_tolerance=1e-5"},                                                \
                 .tolerance = {0.07},                                                                        \
                 .coarse = {0.09}},                                                                          \
                {.name = "mueller", .tolerance = {0.06}, .coarse = {0.06}},                                  \
                {.name = "pbf", .left_out = "steps of 1/60 s hold the wave back or throw it"}},              \
    .metrics = {{"rate of growth", "1/s", .tolerance = 0.08, .coarse = 0.12}},                               \
    .plot = {.x = "time, s",                                                                                 \
             .y = "ln of k times the height of the wave",                                                    \
             .found = {"particles"},                                                                         \
             .expected = {"linear theory"}},                                                                 \
    .start = start, .sample = sample, .judge = judge

const Case case_growth = {
    .name = "growth",
    .help = "a heavy fluid on a light one, 2 : 1: the rate at which a wave between them grows",
    .time = 0.52,
    COMMON,
};

const Case case_growth_10 = {
    .name = "growth_10",
    .help = "the same with 10 : 1",
    .setting = "fluids[0].density=100",
    .time = 0.33,
    COMMON,
};
