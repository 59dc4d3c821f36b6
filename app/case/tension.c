/* Surface tension in the plane, by the cohesion model: how a drop swings, and the pressure in it. */
#include "sim/matter/tension.h"
#include "app/case/all.h"
#include "app/metric/metric.h"
#include "sim/world/method.h"

#include <math.h>

enum { SHAPE, BIG, SMALL };

/* What cohesion presses by in the lattice, Pa: its virial, g sigma V sum C r / (2 d). */
static double cohesion_pressure(const WorldDef *def)
{
    const double h = def->support * def->spacing, volume = def->spacing * def->spacing;
    const int reach = (int)ceil(def->support);
    double sum = 0;
    for (int i = -reach; i <= reach; i++)
        for (int j = -reach; j <= reach; j++) {
            const double r = def->spacing * hypot(i, j);
            sum += cohesion_kernel(r, h) * r;
        }
    return cohesion_scale(2, def->spacing, h) * def->fluids[0].surface_tension * volume * sum / 4;
}

/* An ellipse of the same area, whose axes differ by 0.2 of its radius, with the density that holds cohesion:
   else it would contract at once, and ring. */
static void start_ellipse(const WorldDef *def, CaseStart *state)
{
    const FluidDef *fluid = &def->fluids[0];
    const double c2 = def->sound_speed * def->sound_speed;
    const bool pressed = !method_find(def->method)->incompressible;
    const double ratio = pressed ? pow(1 + 7 * cohesion_pressure(def) / (fluid->density * c2), 1.0 / 7) : 1;
    for (size_t i = 0; i < state->count; i++) {
        for (size_t k = 0; k < 2; k++) {
            const double centre = fluid->fills[0].centre[k];
            float *x = &state->position[3 * i + k];
            *x = (float)(centre + ((double)*x - centre) * (k ? 1 / 1.1 : 1.1));
        }
        state->density[i] = (float)(fluid->density * ratio);
    }
}

static void sample_shape(CaseRun *run)
{
    double axes[2];
    metric_axes(&run->cloud, axes);
    curve_add(&run->column[SHAPE], run->info.time, axes[0] - axes[1]);
}

/* omega^2 = sigma n (n^2 - 1) / (rho R^3), n = 2. */
static bool judge_shape(CaseRun *run, Error *error)
{
    (void)error;
    const FluidDef *fluid = &run->def->fluids[0];
    const Curve *shape = &run->column[SHAPE];
    double axes[2];
    metric_axes(&run->cloud, axes);
    const double radius = sqrt(axes[0] * axes[1]);
    const double omega = sqrt(6 * fluid->surface_tension / (fluid->density * pow(radius, 3)));
    run->figures[0] = figure_relative(2 * M_PI / curve_period(shape), omega);
    for (size_t i = 0; i < shape->count; i++) {
        curve_add(&run->found[0], shape->at[i][0], shape->at[i][1]);
        curve_add(&run->expected[0], shape->at[i][0], 0.2 * radius * cos(omega * shape->at[i][0]));
    }
    return true;
}

const Case case_drop = {
    .name = "drop",
    .help = "a drop that swings by its surface tension, in the plane",
    .scene = "scenes/cases/drop.yaml",
    .methods = {{.name = "wcsph"},
                {.name = "mueller", .tolerance = {0.25}, .coarse = {0.25}},
                {.name = "dfsph",
                 .left_out = "cohesion locks its particles, and the drop swings at a third of its frequency"},
                {.name = "pbf", .left_out = "surface tension at steps of 1/60 s is not looked into yet"}},
    .spacing = {0.001, 0.0005, 0.00025},
    .time = 0.95,
    .every = 0.005,
    .metrics = {{"frequency", "rad/s", .tolerance = 0.07, .coarse = 0.25, .without = "does not oscillate"}},
    .plot = {.x = "time, s",
             .y = "difference of the semi-axes, m",
             .found = {"drop"},
             .expected = {"Rayleigh, without damping"}},
    .start = start_ellipse,
    .sample = sample_shape,
    .judge = judge_shape,
};

static void sample_pressures(CaseRun *run)
{
    for (int d = 0; d < 2; d++) {
        const Fill *fill = &run->def->fluids[0].fills[d];
        double centre[3];
        metric_centre(&run->cloud, d ? 0 : -INFINITY, d ? INFINITY : 0, centre);
        curve_add(&run->column[BIG + d], run->info.time,
                  metric_mean_pressure(&run->cloud, centre, 0.5 * fill->radius));
    }
}

/* Cohesion presses by itself, the same in both drops: what the radius adds is the difference, sigma (1 / R2 -
   1 / R1); the mean over the last third of the time. */
static bool judge_pressures(CaseRun *run, Error *error)
{
    (void)error;
    const FluidDef *fluid = &run->def->fluids[0];
    const double right = fluid->surface_tension * (1 / fluid->fills[1].radius - 1 / fluid->fills[0].radius);
    const Curve *big = &run->column[BIG], *small = &run->column[SMALL];
    double mean = 0, count = 0;
    for (size_t i = 0; i < big->count; i++) {
        const double difference = small->at[i][1] - big->at[i][1];
        curve_add(&run->found[0], big->at[i][0], difference);
        curve_add(&run->expected[0], big->at[i][0], right);
        if (big->at[i][0] > run->info.time * 2 / 3) {
            mean += difference;
            count++;
        }
    }
    run->figures[0] = figure_relative(mean / count, right);
    return true;
}

const Case case_laplace = {
    .name = "laplace",
    .help = "the pressure in a small drop over that in a large one, in the plane",
    .scene = "scenes/cases/laplace.yaml",
    .methods =
        {{.name = "wcsph"},
         {.name = "mueller",
          .left_out = "cohesion presses by 45 times what is looked for, and what it leaves of that is more"},
         {.name = "dfsph",
          .left_out = "cohesion presses by 45 times what is looked for, and what it leaves of that is more"},
         {.name = "pbf",
          .left_out = "cohesion presses by 45 times what is looked for, and what it leaves of that is more"}},
    .spacing = {0.001, 0.0005, 0.00025},
    .time = 0.6,
    .every = 0.005,
    .metrics = {{"pressure difference", "Pa", .tolerance = 0.1, .coarse = 0.1}},
    .plot = {.x = "time, s",
             .y = "pressure difference, Pa",
             .found = {"small drop less large one"},
             .expected = {"sigma / R"}},
    .sample = sample_pressures,
    .judge = judge_pressures,
};
