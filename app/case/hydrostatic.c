/* A column of water at rest: p = rho0 g (H - y), and no energy comes or goes. */
#include "app/case/all.h"
#include "app/metric/metric.h"

#include <math.h>

enum { ENERGY, PRESSURE };

static void sample(CaseRun *run)
{
    Energies e;
    metric_energies(&run->cloud, run->def, &e);
    curve_add(&run->column[ENERGY], run->info.time, e.kinetic + e.potential + e.elastic);
    curve_add(&run->column[PRESSURE], run->info.time,
              metric_hydrostatic(&run->cloud, run->def->fluids[0].density, -run->def->gravity[1], NULL));
}

/* The pressure's error is the mean over the second half of the time, the drift is the greatest, of the
   potential energy. */
static bool judge(CaseRun *run, Error *error)
{
    (void)error;
    const double density = run->def->fluids[0].density, g = -run->def->gravity[1];
    const Curve *energy = &run->column[ENERGY], *pressure = &run->column[PRESSURE];
    double mean = 0, count = 0, drift = 0;
    Energies e;
    metric_energies(&run->cloud, run->def, &e);
    for (size_t i = 0; i < energy->count; i++) {
        drift = figure_worse(drift, fabs(energy->at[i][1] - energy->at[0][1]));
        if (energy->at[i][0] >= 0.5 * run->info.time) {
            mean += pressure->at[i][1];
            count++;
        }
    }
    run->figures[0] = figure_scaled(mean / count, 0, 1);
    run->figures[1] = figure_scaled(drift / e.potential, 0, 1);
    metric_hydrostatic(&run->cloud, density, g, &run->found[0]);
    const double surface = metric_surface(&run->cloud);
    curve_add(&run->expected[0], 0, density * g * surface);
    curve_add(&run->expected[0], surface, 0);
    return true;
}

#define COMMON                                                                                               \
    .methods = {{.name = "wcsph"},                                                                           \
                {.name = "mueller", .tolerance = {0.05}},                                                    \
                {.name = "dfsph", .set = {"solver.divergence_tolerance=1e-5"}, .tolerance = {0.03}},         \
                {.name = "pbf", .tolerance = {0.06}, .coarse = {0.25}}},                                     \
    .time = 5, .every = 0.02,                                                                                \
    .plot = {.x = "height, m",                                                                               \
             .y = "pressure, Pa",                                                                            \
             .found = {"particles"},                                                                         \
             .expected = {"hydrostatic"},                                                                    \
             .dots = true},                                                                                  \
    .sample = sample, .judge = judge

const Case case_hydrostatic = {
    .name = "hydrostatic",
    .help = "a column at rest, in the plane",
    .scene = "scenes/cases/hydrostatic.yaml",
    .metrics = {{"rms pressure over rho0 g H", "", .tolerance = 0.02, .coarse = 0.06},
                {"drift of energy", "", .tolerance = 0.02, .coarse = 0.04}},
    .spacing = {0.05, 0.025, 0.0125},
    COMMON,
};

const Case case_hydrostatic_3d = {
    .name = "hydrostatic_3d",
    .help = "a column at rest",
    .scene = "scenes/cases/hydrostatic_3d.yaml",
    .metrics = {{"rms pressure over rho0 g H", "", .tolerance = 0.02, .coarse = 0.06},
                {"drift of energy", "", .tolerance = 0.02, .coarse = 0.02}},
    .spacing = {0.1, 0.05, 0.025},
    COMMON,
};
