/* Surface tension in the plane: oscillation of a drop, pressure in drops, contact angle of drops on a
   floor. */
#include "app/bench/cases/case_list.h"
#include "app/run/measure/measure.h"

#include <math.h>

enum { SHAPE, BIG, SMALL, DROPS = 3 };

/* Deforms the drop to an ellipse of the same area; the axes differ by 0.2 of the radius. */
static void start_ellipse(const WorldDef *def, CaseStart *state)
{
    const FluidDef *fluid = &def->fluids[0];
    for (size_t i = 0; i < state->count; i++)
        for (size_t k = 0; k < 2; k++) {
            const double centre = fluid->fills[0].centre[k];
            float *x = &state->position[3 * i + k];
            *x = (float)(centre + ((double)*x - centre) * (k ? 1 / 1.1 : 1.1));
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
                {.name = "mueller",
                 .set = {"solver.surface_tension=cohesion"},
                 .tolerance = {0.25},
                 .coarse = {0.25}},
                {.name = "dfsph", .left_out = "no surface tension by curvature"},
                {.name = "pbf", .left_out = "no surface tension by curvature"}},
    .spacing = {0.001, 0.0005, 0.00025},
    .time = 0.95,
    .every = 0.005,
    .metrics = {{"frequency", "rad/s", .tolerance = 0.05, .coarse = 0.1, .without = "does not oscillate"}},
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

/* The pressure difference is sigma (1 / R2 - 1 / R1); takes the mean over the last third of the time. */
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
    .methods = {{.name = "wcsph"},
                {.name = "mueller", .left_out = "no surface tension by curvature"},
                {.name = "dfsph", .left_out = "no surface tension by curvature"},
                {.name = "pbf", .left_out = "no surface tension by curvature"}},
    .spacing = {0.001, 0.0005, 0.00025},
    .time = 0.6,
    .every = 0.005,
    .metrics = {{"pressure difference", "Pa", .tolerance = 0.05, .coarse = 0.2}},
    .plot = {.x = "time, s",
             .y = "pressure difference, Pa",
             .found = {"small drop less large one"},
             .expected = {"sigma / R"}},
    .sample = sample_pressures,
    .judge = judge_pressures,
};

/* Height of the centre of mass of a circular segment with the given contact angle, over the root of the
   segment's area: the shape of a drop on a floor without gravity. */
static double segment_height(double angle)
{
    const double s = sin(angle), area = angle - s * cos(angle);
    return (2 * s * s * s / (3 * area) - cos(angle)) / sqrt(area);
}

/* Returns the contact angle, degrees. */
static double segment_angle(double height, double area)
{
    double low = 0.01, high = M_PI;
    for (int k = 0; k < 50; k++) {
        const double middle = (low + high) / 2;
        *(segment_height(middle) * sqrt(area) < height ? &low : &high) = middle;
    }
    return low * 180 / M_PI;
}

static void sample_angles(CaseRun *run)
{
    const Cloud *cloud = &run->cloud;
    double height[DROPS] = {0}, count[DROPS] = {0};
    for (size_t i = 0; i < cloud->count; i++) {
        height[cloud->fluid[i]] += (double)cloud->position[4 * i + 1];
        count[cloud->fluid[i]]++;
    }
    for (int f = 0; f < DROPS; f++)
        curve_add(&run->column[f], run->info.time,
                  segment_angle(height[f] / count[f], count[f] * cloud->spacing * cloud->spacing));
}

/* Takes the mean over the last third of the time; errors are fractions of a right angle. */
static bool judge_angles(CaseRun *run, Error *error)
{
    (void)error;
    for (int f = 0; f < DROPS; f++) {
        const Curve *angle = &run->column[f];
        const double right = run->def->fluids[f].contact_angle;
        double mean = 0, count = 0;
        for (size_t i = 0; i < angle->count; i++) {
            const double time = angle->at[i][0];
            curve_add(&run->found[f], time, angle->at[i][1]);
            curve_add(&run->expected[f], time, right);
            if (time > run->info.time * 2 / 3) {
                mean += angle->at[i][1];
                count++;
            }
        }
        run->figures[f] = figure_scaled(mean / count, right, 90);
    }
    return true;
}

const Case case_contact_angle = {
    .name = "contact_angle",
    .help = "drops on a floor that they wet more or less, in the plane",
    .scene = "scenes/cases/contact_angle.yaml",
    .methods = {{.name = "wcsph"},
                {.name = "mueller", .left_out = "no surface tension by curvature"},
                {.name = "dfsph", .left_out = "no surface tension by curvature"},
                {.name = "pbf", .left_out = "no surface tension by curvature"}},
    .spacing = {0.001, 0.0005, 0.00025},
    .time = 0.9,
    .every = 0.01,
    .metrics = {{"60 degrees", "degrees", .tolerance = 0.055, .coarse = 0.12}, /* 5 degrees */
                {"90 degrees", "degrees", .tolerance = 0.055, .coarse = 0.12},
                {"120 degrees", "degrees", .tolerance = 0.055, .coarse = 0.12}},
    .plot = {.x = "time, s",
             .y = "contact angle, degrees",
             .found = {"60", "90", "120"},
             .expected = {"60", "90", "120"}},
    .sample = sample_angles,
    .judge = judge_angles,
};
