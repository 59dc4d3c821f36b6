/* Fluid starting in balance: pressures in the first second, in a leaning tank, and with two layers. */
#include "app/bench/cases/case_list.h"
#include "sim/start/start.h"

#include <math.h>

enum { PRESSURE };

/* Hydrostatic pressure at x, Pa: below a level surface by formula, or in layers of blocks, the lowest
   first. */
static double weight_at(const WorldDef *def, const float x[3])
{
    const double *g = def->gravity, at[3] = {(double)x[0], (double)x[1], (double)x[2]};
    double level, sum = 0;
    if (fill_ends(&def->fluids[0].fills[0], 0, 0, &level))
        return def->fluids[0].density * fmax(0, g[0] * at[0] + g[1] * (at[1] - level) + g[2] * at[2]);
    for (int f = 0; f < def->fluid_count; f++) {
        const Fill *fill = &def->fluids[f].fills[0];
        sum -= def->fluids[f].density * g[1] * fmax(0, fill->max[1] - fmax(fill->min[1], at[1]));
    }
    return sum;
}

static void sample(CaseRun *run)
{
    const Cloud *cloud = &run->cloud;
    double sum = 0, most = 0;
    for (size_t i = 0; i < cloud->count; i++) {
        const double weight = weight_at(run->def, cloud->position + 4 * i);
        sum += pow((double)cloud->pressure[i] - weight, 2) / (double)cloud->count;
        most = fmax(most, weight);
    }
    curve_add(&run->column[PRESSURE], run->info.time, sqrt(sum) / most);
}

static bool judge(CaseRun *run, Error *error)
{
    (void)error;
    const Curve *pressure = &run->column[PRESSURE];
    double sum = 0;
    for (size_t i = 0; i < pressure->count; i++) {
        sum += pow(pressure->at[i][1], 2) / (double)pressure->count;
        curve_add(&run->found[0], pressure->at[i][0], pressure->at[i][1]);
    }
    run->figures[0] = figure_scaled(sqrt(sum), 0, 1);
    run->figures[1] = figure_scaled(pressure->at[pressure->count - 1][1], 0, 1);
    return true;
}

#define COMMON                                                                                               \
    .time = 1, .every = 0.02,                                                                                \
    .plot = {.x = "time, s",                                                                                 \
             .y = "rms pressure off the weight above, over the greatest",                                    \
             .found = {"particles"}},                                                                        \
    .sample = sample, .judge = judge

const Case case_tilted = {
    .name = "tilted",
    .help = "a tank at rest that leans by 20 degrees: pressures of its first second",
    .scene = "scenes/tilted.yaml",
    .methods = {{.name = "wcsph"},
                {.name = "mueller", .tolerance = {0.25}, .coarse = {0.4}},
                {.name = "dfsph", .tolerance = {0.025}, .coarse = {0.075}},
                {.name = "pbf", .tolerance = {0.3}, .coarse = {0.3}}},
    .spacing = {0.05, 0.02, 0.01},
    .metrics = {{"rms pressure in the first second", "", .tolerance = 0.015, .coarse = 0.03}},
    COMMON,
};

#define MUELLER                                                                                              \
    {                                                                                                        \
        .name = "mueller", .tolerance = {0.04, 0.04}, .coarse = { 0.07, 0.07 }                               \
    }
#define DFSPH                                                                                                \
    {                                                                                                        \
        .name = "dfsph", .tolerance = {0.035, 0.035}, .coarse = { 0.07, 0.07 }                               \
    }

/* At a support of 3.1, which moves better, light particles clump under a free surface. The second figure is
   of a single moment: 3.4 to 6.7 % by chance. */
#define DFSPH_RESTS                                                                                          \
    {                                                                                                        \
        .name = "dfsph", .set = {"particles.support=2.6", "solver.surface_lack=0"},                          \
        .tolerance = {0.035, 0.07}, .coarse = {                                                              \
            0.07,                                                                                            \
            0.1                                                                                              \
        }                                                                                                    \
    }

#define LAYERS(...)                                                                                          \
    .scene = "scenes/cases/layers.yaml", .methods = {{.name = "wcsph"}, __VA_ARGS__},                        \
    .spacing = {0.05, 0.025, 0.0125},                                                                        \
    .metrics = {{"rms pressure in the first second", "", .tolerance = 0.01, .coarse = 0.02},                 \
                {"rms pressure after it", "", .tolerance = 0.01, .coarse = 0.02}},                           \
    COMMON

const Case case_layers = {
    .name = "layers",
    .help = "a light fluid at rest on a heavy one, 1 : 2: pressures of their first second",
    LAYERS(MUELLER, DFSPH, {.name = "pbf", .tolerance = {0.3, 0.3}, .coarse = {0.3, 0.3}}),
};

const Case case_layers_10 = {
    .name = "layers_10",
    .help = "the same with 1 : 10",
    .setting = "fluids[1].density=100",
    LAYERS(MUELLER, DFSPH, {.name = "pbf", .left_out = "its pressures are off by a third at this ratio"}),
};

const Case case_layers_1000 = {
    .name = "layers_1000",
    .help = "the same with 1 : 1000",
    .setting = "fluids[1].density=1",
    LAYERS(DFSPH_RESTS, {.name = "mueller", .left_out = "it throws single light particles at this ratio"},
           {.name = "pbf", .left_out = "its pressures are off by a third at a tenth of this ratio"}),
};
