/* A standing wave of half a wavelength in a tank with slip walls, and its viscous decay. */
#include "app/bench/cases/case.h"
#include "app/bench/cases/case_list.h"
#include "app/run/measure/measure.h"

#include <complex.h>
#include <math.h>

static double surface_of(const WorldDef *def, const CaseStart *start)
{
    double top = 0;
    for (size_t i = 0; i < start->count; i++)
        top = fmax(top, start->position[3 * i + 1]);
    return top + 0.5 * def->spacing;
}

/* Adds a standing wave of half a wavelength in the width of the first fill, around x = 0: linear potential
   flow at the moment of a flat surface and greatest velocities. `height` (m) is the amplitude at the
   walls. phi = -(height g / omega) cosh(k y) / cosh(k H) cos(k (x + L / 2)), k = pi / L; Lamb, Hydrodynamics,
   228. */
static void start_wave(const WorldDef *def, CaseStart *start, double height)
{
    const Fill *fill = &def->fluids[0].fills[0];
    const double g = -def->gravity[1], length = fill->max[0] - fill->min[0], k = M_PI / length;
    const double surface = surface_of(def, start), omega = sqrt(g * k * tanh(k * surface));
    const double scale = height * g / omega * k / cosh(k * surface);
    for (size_t i = 0; i < start->count; i++) {
        const double x = k * (start->position[3 * i] + 0.5 * length), y = k * start->position[3 * i + 1];
        start->velocity[3 * i] = (float)(scale * cosh(y) * sin(x));
        start->velocity[3 * i + 1] = (float)(-scale * sinh(y) * cos(x));
    }
}

enum { CENTRE };

static const double HEIGHT = 0.03; /* wave height over depth: small, for linear theory */

static void start(const WorldDef *def, CaseStart *state)
{
    const Fill *fill = &def->fluids[0].fills[0];
    start_wave(def, state, HEIGHT * (fill->max[1] - fill->min[1]));
}

static void sample(CaseRun *run)
{
    double centre[3];
    metric_centre(&run->cloud, -INFINITY, INFINITY, centre);
    curve_add(&run->column[CENTRE], run->info.time, centre[0]);
}

/* Returns alpha = -decay + i omega of waves proportional to exp(alpha t), with (alpha + 2 nu k^2)^2 + g k
   tanh(k d) = 4 nu^2 k^4 sqrt(1 + alpha / (nu k^2)): Lamb, Hydrodynamics, 349, for deep water. A slip
   floor adds no boundary layer, and at k d = pi tanh is within 0.4 % of 1. Newton's method, starting at
   the inviscid value. */
static double complex viscous_wave(double nu, double k, double restoring)
{
    const double s = nu * k * k;
    double complex alpha = -2 * s + I * sqrt(restoring);
    for (int i = 0; i < 30; i++) {
        const double complex root = csqrt(1 + alpha / s);
        const double complex f = (alpha + 2 * s) * (alpha + 2 * s) + restoring - 4 * s * s * root;
        alpha -= f / (2 * (alpha + 2 * s) - 2 * s / root);
    }
    return alpha;
}

static bool judge(CaseRun *run, Error *error)
{
    (void)error;
    const WorldDef *def = run->def;
    const Fill *fill = &def->fluids[0].fills[0];
    const double k = M_PI / (fill->max[0] - fill->min[0]), depth = fill->max[1] - fill->min[1];
    const double nu = def->fluids[0].viscosity / def->fluids[0].density;
    const double complex alpha = viscous_wave(nu, k, -def->gravity[1] * k * tanh(k * depth));
    const Curve *centre = &run->column[CENTRE];
    Curve peaks = {.count = 0};
    curve_log_peaks(centre, &peaks);
    run->figures[0] = figure_relative(-curve_slope(&peaks), -creal(alpha));
    run->figures[1] = figure_relative(2 * M_PI / curve_period(centre), cimag(alpha));
    const double first = peaks.count > 0 ? exp(peaks.at[0][1] - creal(alpha) * peaks.at[0][0]) : 0;
    for (size_t i = 0; i < centre->count; i++) {
        const double t = centre->at[i][0];
        curve_add(&run->found[0], t, centre->at[i][1]);
        curve_add(&run->expected[0], t, first * exp(creal(alpha) * t));
        curve_add(&run->expected[1], t, -first * exp(creal(alpha) * t));
    }
    curve_free(&peaks);
    return true;
}

const Case case_wave = {
    .name = "standing_wave",
    .help = "a standing wave: its viscous decay and its frequency",
    .scene = "scenes/cases/standing_wave.yaml",
    .methods = {{.name = "wcsph"},
                {.name = "mueller", .tolerance = {0.06, 0.08}, .coarse = {1, 0.1}},
                {.name = "dfsph", .tolerance = {0.5, 0.01}, .coarse = {0.4, 0.01}},
                {.name = "pbf",
                 .left_out = "steps of 1/60 s damp the wave two to three times as much as friction does"}},
    .spacing = {0.05, 0.025, 0.0125},
    .time = 5.5,
    .every = 0.02,
    .metrics = {{"decay", "1/s", .tolerance = 0.02, .coarse = 0.02, .without = "does not oscillate"},
                {"frequency", "rad/s", .tolerance = 0.015, .coarse = 0.02, .without = "does not oscillate"}},
    .plot = {.x = "time, s",
             .y = "centre of mass, m",
             .found = {"centre"},
             .expected = {"linear theory's decay", "the same below"}},
    .start = start,
    .sample = sample,
    .judge = judge,
};
