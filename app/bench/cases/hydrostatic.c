/* A column of water at rest: p = rho0 g (H - y), and energy is conserved. Measured by particles and by the
   scene's probes: sensors on the floor and on a wall, and a gauge of the height. */
#include "app/bench/cases/case_list.h"
#include "app/run/measure/measure.h"

#include <math.h>

enum { ENERGY, PRESSURE, FLOOR, WALL, HEIGHT, COLUMNS };

static void sample(CaseRun *run)
{
    Energies e;
    metric_energies(&run->cloud, run->def, &e);
    curve_add(&run->column[ENERGY], run->info.time, e.kinetic + e.potential + e.elastic);
    curve_add(&run->column[PRESSURE], run->info.time,
              metric_hydrostatic(&run->cloud, run->def->fluids[0].density, -run->def->gravity[1], NULL));
    for (int c = FLOOR; c < COLUMNS; c++)
        curve_add(&run->column[c], run->info.time, (double)run->probe[c - FLOOR]);
}

/* Mean over the second half of the time. */
static double late_mean(const CaseRun *run, int column)
{
    const Curve *curve = &run->column[column];
    double sum = 0, count = 0;
    for (size_t i = 0; i < curve->count; i++)
        if (curve->at[i][0] >= 0.5 * run->info.time) {
            sum += curve->at[i][1];
            count++;
        }
    return sum / count;
}

/* Judges the scene's probes. The pressure on the floor is the fluid's weight, however compressed. On the
   wall, WALL_AT m above the floor, the fluid below is denser by 1 / 200. */
static void judge_probes(CaseRun *run, double density, double g)
{
    static const double WALL_AT = 0.25;
    const Fill *fill = &run->def->fluids[0].fills[0];
    const double high = fill->max[1] - fill->min[1], weight = density * g * high;
    const double wall = late_mean(run, WALL) - density * g * (high - WALL_AT);
    run->figures[2] = figure_scaled(fmax(fabs(late_mean(run, FLOOR) - weight), fabs(wall)) / weight, 0, 1);
    run->figures[3] = figure_relative(late_mean(run, HEIGHT), high);
}

/* Errors: of the pressure the mean over the second half of the time, of the drift the greatest, relative
   to the potential energy. */
static bool judge(CaseRun *run, Error *error)
{
    (void)error;
    const double density = run->def->fluids[0].density, g = -run->def->gravity[1];
    const Curve *energy = &run->column[ENERGY];
    double drift = 0;
    Energies e;
    metric_energies(&run->cloud, run->def, &e);
    for (size_t i = 0; i < energy->count; i++)
        drift = figure_worse(drift, fabs(energy->at[i][1] - energy->at[0][1]));
    run->figures[0] = figure_scaled(late_mean(run, PRESSURE), 0, 1);
    run->figures[1] = figure_scaled(drift / e.potential, 0, 1);
    judge_probes(run, density, g);
    metric_hydrostatic(&run->cloud, density, g, &run->found[0]);
    const double surface = metric_surface(&run->cloud);
    curve_add(&run->expected[0], 0, density * g * surface);
    curve_add(&run->expected[0], surface, 0);
    return true;
}

#define COMMON                                                                                               \
    .methods = {{.name = "wcsph"},                                                                           \
                {.name = "mueller", .tolerance = {0.025, 0.0005, 0.02}, .coarse = {0, 0.003, 0.025, 0.025}}, \
                {.name = "dfsph",                                                                            \
                 .set = {"solver.divergence_tolerance=1e-5"},                                                \
                 .tolerance = {0.03, 0, 0.003}},                                                             \
                {.name = "pbf", .tolerance = {0.04, 0, 0.025, 0.013}, .coarse = {0.2, 0, 0.04, 0.02}}},      \
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
                {"drift of energy", "", .tolerance = 0.02, .coarse = 0.04},
                {"sensors, worst over rho0 g H", "", .tolerance = 0.01, .coarse = 0.01},
                {"height by a gauge", "m", .tolerance = 0.008, .coarse = 0.008}},
    .spacing = {0.05, 0.025, 0.0125},
    COMMON,
};

const Case case_hydrostatic_3d = {
    .name = "hydrostatic_3d",
    .help = "a column at rest",
    .scene = "scenes/cases/hydrostatic_3d.yaml",
    .metrics = {{"rms pressure over rho0 g H", "", .tolerance = 0.02, .coarse = 0.06},
                {"drift of energy", "", .tolerance = 0.02, .coarse = 0.02},
                {"sensors, worst over rho0 g H", "", .tolerance = 0.01, .coarse = 0.01},
                {"height by a gauge", "m", .tolerance = 0.008, .coarse = 0.008}},
    .spacing = {0.1, 0.05, 0.025},
    COMMON,
};
