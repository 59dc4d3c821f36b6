/* A box in free fall: in its frame, the fluid floats in place. */
#include "app/bench/cases/case_list.h"
#include "app/run/measure/measure.h"

#include <math.h>

enum { HEIGHT };

static void sample(CaseRun *run)
{
    double centre[3];
    metric_centre(&run->cloud, -INFINITY, INFINITY, centre);
    curve_add(&run->column[HEIGHT], run->info.time, centre[1]);
}

/* Errors over the distance and the energy of the fall, g t^2 / 2 and m (g t)^2 / 2. */
static bool judge(CaseRun *run, Error *error)
{
    (void)error;
    const double g = -run->def->gravity[1], t = run->info.time, way = 0.5 * g * t * t;
    const Curve *height = &run->column[HEIGHT];
    double most = 0, mass = 0;
    Energies e;
    metric_energies(&run->cloud, run->def, &e);
    for (size_t i = 0; i < height->count; i++) {
        const double moved = height->at[i][1] - height->at[0][1];
        most = figure_worse(most, fabs(moved));
        curve_add(&run->found[0], height->at[i][0], moved / way);
        curve_add(&run->expected[0], height->at[i][0], 0);
    }
    mass =
        run->def->fluids[0].density * pow(run->def->spacing, run->def->dimensions) * (double)run->cloud.count;
    run->figures[0] = figure_scaled(most, 0, way);
    run->figures[1] = figure_scaled(e.kinetic, 0, mass * g * way);
    return true;
}

const Case case_free_fall = {
    .name = "free_fall",
    .help = "a box that falls freely: the fluid floats in it",
    .scene = "scenes/cases/free_fall.yaml",
    .methods = {{.name = "wcsph"},
                {.name = "mueller"},
                {.name = "dfsph"},
                {.name = "pbf", .tolerance = {0.02}, .coarse = {0.02}}},
    .spacing = {0.1, 0.05, 0.025},
    .time = 1,
    .every = 0.02,
    .metrics = {{"way of the centre", "m", .tolerance = 1e-4, .coarse = 1e-4},
                {"kinetic energy", "J", .tolerance = 1e-4, .coarse = 1e-4}},
    .plot = {.x = "time, s",
             .y = "way of the centre over g t^2 / 2",
             .found = {"centre"},
             .expected = {"exact"}},
    .sample = sample,
    .judge = judge,
};
