/* Taylor-Green vortices in a periodic square: the energy falls as exp(-16 pi^2 nu t / L^2). */
#include "app/bench/cases/case_list.h"
#include "app/run/measure/measure.h"

#include <math.h>

enum { ENERGY };

static void sample(CaseRun *run)
{
    Energies e;
    metric_energies(&run->cloud, run->def, &e);
    curve_add(&run->column[ENERGY], run->info.time, log(e.kinetic));
}

static bool judge(CaseRun *run, Error *error)
{
    (void)error;
    const FluidDef *fluid = &run->def->fluids[0];
    const double side = run->def->box_size[0], nu = fluid->viscosity / fluid->density;
    const double right = -16 * M_PI * M_PI * nu / (side * side);
    const Curve *energy = &run->column[ENERGY];
    for (size_t i = 0; i < energy->count; i++) {
        curve_add(&run->found[0], energy->at[i][0], energy->at[i][1] - energy->at[0][1]);
        curve_add(&run->expected[0], energy->at[i][0], right * energy->at[i][0]);
    }
    run->figures[0] = figure_relative(curve_slope(energy), right);
    return true;
}

#define LINES_UP "shifting is wcsph's alone, and saddle points line its particles up"
#define COMMON                                                                                               \
    .scene = "scenes/cases/taylor_green.yaml",                                                               \
    .methods = {{.name = "wcsph"},                                                                           \
                {.name = "mueller", .left_out = LINES_UP},                                                   \
                {.name = "dfsph", .left_out = LINES_UP},                                                     \
                {.name = "pbf", .left_out = LINES_UP}},                                                      \
    .time = 1.5, .every = 0.02, .sample = sample, .judge = judge,                                            \
    .plot = {.x = "time, s",                                                                                 \
             .y = "ln of the kinetic energy over the start's",                                               \
             .found = {"energy"},                                                                            \
             .expected = {"exact"}}

const Case case_vortices = {
    .name = "taylor_green",
    .help = "Taylor and Green's vortices, Re 100: the decay of their energy",
    .spacing = {0.04, 0.01, 0.005},
    .metrics = {{"slope of ln energy", "1/s", .tolerance = 0.03, .coarse = 0.05}},
    COMMON,
};

const Case case_vortices_1000 = {
    .name = "taylor_green_1000",
    .help = "Taylor and Green's vortices, Re 1000: what else than viscosity takes their energy",
    .setting = "fluids[0].viscosity=1",
    .spacing = {0.04, 0.01, 0.005},
    .metrics = {{"slope of ln energy", "1/s", .tolerance = 0.02, .coarse = 0.06}},
    COMMON,
};
