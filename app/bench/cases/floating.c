/* Floating bodies of half the density of water: a rolling square prism, a bobbing cylinder.
   A square of side L, lower half under water, floats on its edge: a flat position would be unstable, by a
   metacentric height of L / 6 - L / 4. On its edge the waterplane is sqrt(2) L wide, GM = I / V - BG =
   sqrt(2) L / 3 - sqrt(2) L / 6, and theta'' (J + j) = -m g GM theta for the smallest angles: a period of
   6.37 sqrt(L / g). At eight degrees the righting moment is a quarter less, so the exact moment is
   integrated. J = m L^2 / 6 is the body's own inertia. The added inertia j of the water, in roll coupled
   with sway, 0.0378 rho L^4, comes from linear potential flow: sources on the wetted surface (W. Frank,
   "Oscillation of cylinders in or below the free surface of deep fluids", 1967), solved with 80 panels.
   A half-immersed cylinder released above its level is the classical transient of S. J. Maskell and F.
   Ursell, "The transient motion of a floating body", Journal of Fluid Mechanics 44, 1970. The reference
   uses the added mass and the damping of F. Ursell, "On the heaving motion of a circular cylinder on the
   surface of a fluid", 1949 (0.60 rho pi a^2 / 2 near the natural frequency), by the same panels and a
   Fourier integral. */
#include "app/bench/cases/case_list.h"

#include <math.h>

enum { TURN, HEIGHT };

static const double ADDED_ROLL = 0.0378, ROLL_DAMPING = 0.0070; /* rho L^4; rho L^4 sqrt(g / L) */

static void sample(CaseRun *run)
{
    const BoxState *pose = &run->info.floating[0];
    const double *q = pose->orientation;
    curve_add(&run->column[TURN], run->info.time, 2 * atan2(q[2], q[3]));
    curve_add(&run->column[HEIGHT], run->info.time, pose->position[1]);
}

/* Water level, m, in the box, with an area `section` of the body under water. */
static double level_of(const WorldDef *def, double water, double section)
{
    return (water + section) / def->box_size[0];
}

/* Area of the water, m2: each particle has the area spacing^2. */
static double water_of(const CaseRun *run)
{
    return pow(run->def->spacing, 2) * (double)run->cloud.count;
}

static double mean(const Curve *curve, double from)
{
    double sum = 0, count = 0;
    for (size_t i = 0; i < curve->count; i++)
        if (curve->at[i][0] >= from) {
            sum += curve->at[i][1];
            count++;
        }
    return sum / count;
}

/* Depth of the centroid of the immersed part, over the side, for a square turned by `angle`: half of the
   mean of |sin x + cos y|. The minimum is on the edge; the growth away from the edge is less than
   quadratic. */
static double depth_at(double angle)
{
    const double a = fabs(sin(angle)), b = fabs(cos(angle)), more = fmax(a, b), less = fmin(a, b);
    return more / 4 + less * less / (12 * more);
}

static double torque_at(double angle)
{
    static const double STEP = 1e-4;
    return -0.5 * (depth_at(angle + STEP) - depth_at(angle - STEP)) / (2 * STEP);
}

/* Integrates theta'' (J + j) = torque - damping, in units of rho, L and g, up to the simulated time. */
static void theory_of_roll(double first, double unit, double end, Curve *theory)
{
    static const double DT = 0.002;
    const double upright = M_PI / 4;
    double angle = first, rate = 0;
    for (int i = 0; i * DT * unit <= end; i++) {
        if (i % 10 == 0)
            curve_add(theory, i * DT * unit, angle);
        rate += DT * (torque_at(upright + angle) - ROLL_DAMPING * rate) / (1.0 / 12 + ADDED_ROLL);
        angle += DT * rate;
    }
}

static bool judge_roll(CaseRun *run, Error *error)
{
    (void)error;
    const double side = run->def->solids[0].size[0], unit = sqrt(-side / run->def->gravity[1]);
    const double degrees = 180 / M_PI, upright = M_PI / 4, end = run->info.time;
    Curve roll = {.count = 0}, theory = {.count = 0};
    for (size_t i = 0; i < run->column[TURN].count; i++) {
        const double *at = run->column[TURN].at[i];
        curve_add(&roll, at[0], at[1] - upright);
        curve_add(&run->found[0], at[0], (at[1] - upright) * degrees);
    }
    theory_of_roll(run->column[TURN].at[0][1] - upright, unit, end, &theory);
    for (size_t i = 0; i < theory.count; i++)
        curve_add(&run->expected[0], theory.at[i][0], theory.at[i][1] * degrees);
    const double period = curve_period(&theory), level = level_of(run->def, water_of(run), 0.5 * side * side),
                 middle = mean(&run->column[HEIGHT], end - period);
    run->figures[0] = figure_relative(curve_period(&roll), period);
    run->figures[1] = figure_relative(0.5 + (level - middle) / (sqrt(2) * side), 0.5);
    curve_free(&roll);
    curve_free(&theory);
    return true;
}

#define PBF_OUT                                                                                              \
    "it lies as deep, but a sixtieth of a second is long beside what first bears a body that is let go"

const Case case_floating = {
    .name = "floating",
    .help =
        "a square prism of half the density floats on its edge and rolls: its period, and how deep it lies",
    .scene = "scenes/cases/floating.yaml",
    .methods = {{.name = "wcsph"},
                {.name = "mueller", .coarse = {0.2}},
                /* coarse: the start decides; of eight starts 1.4 to 20.4 %, 8 % in the mean */
                {.name = "dfsph", .coarse = {0.05}},
                {.name = "pbf", .left_out = PBF_OUT}},
    .spacing = {0.4 / 12, 0.4 / 24, 0.4 / 32},
    .time = 2.6,
    .every = 0.01,
    .metrics = {{"period of roll", "s", .tolerance = 0.1, .coarse = 0.1, .without = "does not roll"},
                {"height under water", "", .tolerance = 0.03, .coarse = 0.03}},
    .plot = {.x = "time, s",
             .y = "turned off its edge, degrees",
             .found = {"body"},
             .expected = {"potential flow"}},
    .sample = sample,
    .judge = judge_roll,
};

/* Transient of Maskell and Ursell: height over the initial height, at each quarter of sqrt(a / g). */
static const double TRANSIENT[] = {1.000,  0.980,  0.922,  0.829,  0.705,  0.557,  0.392,  0.219,  0.045,
                                   -0.121, -0.273, -0.403, -0.508, -0.583, -0.627, -0.640, -0.624, -0.580,
                                   -0.514, -0.429, -0.331, -0.227, -0.121, -0.019, 0.074,  0.155,  0.220,
                                   0.267,  0.295,  0.305,  0.296,  0.271,  0.233,  0.184,  0.128,  0.068,
                                   0.007,  -0.050, -0.102, -0.145, -0.179, -0.202, -0.213, -0.213, -0.203,
                                   -0.183, -0.156, -0.123, -0.086, -0.048, -0.010, 0.025,  0.055};

static double transient_at(double time)
{
    enum { COUNT = sizeof TRANSIENT / sizeof *TRANSIENT };
    const double at = 4 * time;
    const int i = (int)fmin(at, COUNT - 2);
    return TRANSIENT[i] + (at - i) * (TRANSIENT[i + 1] - TRANSIENT[i]);
}

static bool judge_heave(CaseRun *run, Error *error)
{
    (void)error;
    const double radius = run->def->solids[0].radius, g = -run->def->gravity[1], unit = sqrt(radius / g);
    const double level = level_of(run->def, water_of(run), 0.5 * M_PI * radius * radius);
    const double first = run->column[HEIGHT].at[0][1] - level;
    Curve theory = {.count = 0}, found = {.count = 0};
    double off = 0, all = 0;
    for (size_t i = 0; i < run->column[HEIGHT].count; i++) {
        const double *at = run->column[HEIGHT].at[i], expected = transient_at(at[0] / unit),
                     value = (at[1] - level) / first;
        curve_add(&found, at[0], value);
        curve_add(&theory, at[0], expected);
        curve_add(&run->found[0], at[0], value);
        curve_add(&run->expected[0], at[0], expected);
        off += pow(value - expected, 2);
        all += pow(expected, 2);
    }
    run->figures[0] = figure_relative(curve_period(&found), curve_period(&theory));
    run->figures[1] = figure_scaled(sqrt(off / all), 0, 1);
    curve_free(&found);
    curve_free(&theory);
    return true;
}

const Case case_heaving = {
    .name = "heaving",
    .help = "a half-immersed cylinder is let go above its level: Maskell and Ursell's transient",
    .scene = "scenes/cases/heaving.yaml",
    .methods = {{.name = "wcsph"},
                {.name = "mueller", .coarse = {0.1, 0.35}},
                {.name = "dfsph", .tolerance = {0.03, 0.3}, .coarse = {0.05, 0.3}},
                {.name = "pbf", .left_out = PBF_OUT}},
    .spacing = {0.2 / 6.5, 0.2 / 10, 0.2 / 16},
    .time = 1.4,
    .every = 0.01,
    .metrics = {{"period of heave", "s", .tolerance = 0.1, .coarse = 0.1, .without = "does not swing"},
                {"height over time", "", .tolerance = 0.25, .coarse = 0.3}},
    .plot = {.x = "time, s",
             .y = "height over the first one",
             .found = {"body"},
             .expected = {"linear theory"}},
    .sample = sample,
    .judge = judge_heave,
};
