#include "app/run/measure/measure.h"

#include "sim/step/method.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void curve_add(Curve *curve, double x, double y)
{
    if (curve->count == curve->capacity) {
        const size_t capacity = curve->capacity ? 2 * curve->capacity : 256;
        double(*at)[2] = realloc(curve->at, capacity * sizeof *at);
        if (!at) {
            fputs("slosh: no memory for a curve\n", stderr);
            abort();
        }
        curve->at = at;
        curve->capacity = capacity;
    }
    curve->at[curve->count][0] = x;
    curve->at[curve->count++][1] = y;
}

void curve_free(Curve *curve)
{
    free(curve->at);
    *curve = (Curve){.count = 0};
}

double curve_at(const Curve *curve, double x)
{
    for (size_t i = 1; i < curve->count; i++) {
        const double *a = curve->at[i - 1], *b = curve->at[i];
        if (a[0] <= x && x <= b[0])
            return b[0] > a[0] ? a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0]) : a[1];
    }
    return NAN;
}

double curve_slope(const Curve *curve)
{
    const double n = (double)curve->count;
    double mean[2] = {0}, xx = 0, xy = 0;
    for (size_t i = 0; i < curve->count; i++)
        for (int k = 0; k < 2; k++)
            mean[k] += curve->at[i][k] / n;
    for (size_t i = 0; i < curve->count; i++) {
        const double x = curve->at[i][0] - mean[0];
        xx += x * x;
        xy += x * (curve->at[i][1] - mean[1]);
    }
    return xx > 0 ? xy / xx : (double)NAN;
}

/* True if y crosses 0 between points i - 1 and i. */
static bool passes(const Curve *curve, size_t i)
{
    return (curve->at[i - 1][1] < 0) != (curve->at[i][1] < 0);
}

double curve_period(const Curve *curve)
{
    double first = 0, last = 0;
    int passings = 0;
    for (size_t i = 1; i < curve->count; i++) {
        const double *a = curve->at[i - 1], *b = curve->at[i];
        if (!passes(curve, i))
            continue;
        last = a[0] + (a[0] - b[0]) * a[1] / (b[1] - a[1]);
        if (passings++ == 0)
            first = last;
    }
    return passings > 2 ? 2 * (last - first) / (passings - 1) : (double)NAN;
}

/* Adds the top of the parabola through |y| at points i - 1, i and i + 1, evenly spaced. */
static void add_peak(const Curve *curve, size_t i, Curve *peaks)
{
    const double a = fabs(curve->at[i - 1][1]), b = fabs(curve->at[i][1]), c = fabs(curve->at[i + 1][1]),
                 bend = a - 2 * b + c;
    const double shift = bend < 0 ? 0.5 * (a - c) / bend : 0;
    const double step = 0.5 * (curve->at[i + 1][0] - curve->at[i - 1][0]);
    curve_add(peaks, curve->at[i][0] + shift * step, log(b - 0.25 * (a - c) * shift));
}

void curve_log_peaks(const Curve *curve, Curve *peaks)
{
    size_t top = 0;
    for (size_t i = 1; i + 1 < curve->count; i++) {
        if (passes(curve, i)) {
            if (top > 0)
                add_peak(curve, top, peaks);
            top = i;
        } else if (top > 0 && fabs(curve->at[i][1]) > fabs(curve->at[top][1])) {
            top = i;
        }
    }
}

static double distance2(const float *a, const float *b)
{
    double sum = 0;
    for (int k = 0; k < 3; k++)
        sum += ((double)a[k] - b[k]) * ((double)a[k] - b[k]);
    return sum;
}

static bool has_neighbours(const Cloud *cloud, size_t i, int least)
{
    const double h2 = cloud->support_radius * cloud->support_radius;
    for (size_t j = 0; j < cloud->count && least > 0; j++)
        if (j != i && distance2(cloud->position + 4 * i, cloud->position + 4 * j) < h2)
            least--;
    return least == 0;
}

double metric_front(const Cloud *cloud)
{
    enum { NEIGHBOURS = 5 };
    double front = -INFINITY;
    for (size_t i = 0; i < cloud->count; i++) {
        const float *x = cloud->position + 4 * i;
        if (x[0] > front && x[1] < 2 * cloud->spacing && has_neighbours(cloud, i, NEIGHBOURS))
            front = x[0];
    }
    return front > -INFINITY ? front + 0.5 * cloud->spacing : (double)NAN;
}

/* Surface height over the particles with x < below. */
static double surface_before(const Cloud *cloud, double below)
{
    double top = -INFINITY, sum = 0, count = 0;
    for (size_t i = 0; i < cloud->count; i++)
        if ((double)cloud->position[4 * i] < below)
            top = fmax(top, cloud->position[4 * i + 1]);
    for (size_t i = 0; i < cloud->count; i++)
        if ((double)cloud->position[4 * i] < below &&
            cloud->position[4 * i + 1] > top - 0.5 * cloud->spacing) {
            sum += cloud->position[4 * i + 1];
            count++;
        }
    return sum / count + 0.5 * cloud->spacing;
}

double metric_surface(const Cloud *cloud)
{
    return surface_before(cloud, INFINITY);
}

double metric_wall_height(const Cloud *cloud, double wall)
{
    return surface_before(cloud, wall + 3 * cloud->spacing);
}

double metric_hydrostatic(const Cloud *cloud, double density, double gravity, Curve *points)
{
    const double surface = metric_surface(cloud);
    double sum2 = 0;
    for (size_t i = 0; i < cloud->count; i++) {
        const double y = cloud->position[4 * i + 1], p = cloud->pressure[i];
        sum2 += pow(p - density * gravity * (surface - y), 2) / (double)cloud->count;
        if (points)
            curve_add(points, y, p);
    }
    return sqrt(sum2) / (density * gravity * surface);
}

double metric_paraboloid(const Cloud *cloud, double width, Curve *points)
{
    enum { CELLS = 256 };
    Curve all = {.count = 0};
    const int n = (int)fmin(width / cloud->spacing + 0.5, CELLS);
    size_t *top =
        calloc((size_t)n * (size_t)n + 1, sizeof *top); /* index + 1 of each cell's highest particle */
    if (!top)
        return NAN;
    for (size_t i = 0; i < cloud->count; i++) {
        const float *x = cloud->position + 4 * i;
        const int a = (int)floor((x[0] / width + 0.5) * n), b = (int)floor((x[2] / width + 0.5) * n);
        const int cell = a * n + b;
        if (a > 0 && a < n - 1 && b > 0 && b < n - 1 &&
            (!top[cell] || x[1] > cloud->position[4 * (top[cell] - 1) + 1]))
            top[cell] = i + 1;
    }
    for (int cell = 0; cell < n * n; cell++) {
        if (!top[cell])
            continue;
        const float *x = cloud->position + 4 * (top[cell] - 1);
        const double r2 = (double)x[0] * x[0] + (double)x[2] * x[2];
        curve_add(&all, r2, x[1]);
        if (points)
            curve_add(points, sqrt(r2), x[1] + 0.5 * cloud->spacing);
    }
    const double slope = curve_slope(&all);
    curve_free(&all);
    free(top);
    return slope;
}

void metric_centre(const Cloud *cloud, double low, double high, double centre[3])
{
    double sum[3] = {0}, count = 0;
    for (size_t i = 0; i < cloud->count; i++) {
        const float *x = cloud->position + 4 * i;
        if (x[0] < low || x[0] >= high)
            continue;
        count++;
        for (int k = 0; k < 3; k++)
            sum[k] += x[k];
    }
    for (int k = 0; k < 3; k++)
        centre[k] = sum[k] / count;
}

void metric_axes(const Cloud *cloud, double axes[2])
{
    double centre[3];
    metric_centre(cloud, -INFINITY, INFINITY, centre);
    for (int k = 0; k < 2; k++) {
        double sum2 = 0;
        for (size_t i = 0; i < cloud->count; i++)
            sum2 += pow(cloud->position[4 * i + (size_t)k] - centre[k], 2) / (double)cloud->count;
        axes[k] = 2 * sqrt(sum2 + cloud->spacing * cloud->spacing / 12);
    }
}

double metric_mean_pressure(const Cloud *cloud, const double centre[3], double radius)
{
    double sum = 0, count = 0;
    for (size_t i = 0; i < cloud->count; i++) {
        double r2 = 0;
        for (size_t k = 0; k < 3; k++)
            r2 += pow(cloud->position[4 * i + k] - centre[k], 2);
        if (r2 < radius * radius) {
            sum += cloud->pressure[i];
            count++;
        }
    }
    return sum / count;
}

void metric_energies(const Cloud *cloud, const WorldDef *def, Energies *energies)
{
    const double volume = pow(def->spacing, def->dimensions), c2 = def->sound_speed * def->sound_speed;
    const Method *method = method_find(def->method);
    *energies = (Energies){0};
    for (size_t i = 0; i < cloud->count; i++) {
        const double rest = def->fluids[cloud->fluid[i]].density, mass = rest * volume;
        const float *v = cloud->velocity + 4 * i;
        const double ratio = cloud->density[i] / rest;
        double v2 = 0;
        for (int k = 0; k < 3; k++) {
            v2 += (double)v[k] * v[k];
            energies->potential -= mass * def->gravity[k] * cloud->position[4 * i + (size_t)k];
        }
        energies->kinetic += 0.5 * mass * v2;
        if (method->energy && (cloud->pressure[i] > 0 || def->negative_pressure))
            energies->elastic += mass * c2 * method->energy(ratio - 1);
    }
}

/* Solves the symmetric 3 x 3 system of f = c0 + c1 x + c2 y for both velocity components at the origin, by
   Cramer's rule. */
static bool solve_at_origin(double m[3][3], double b[2][3], double out[2])
{
    const double a = m[1][1] * m[2][2] - m[1][2] * m[2][1], d = m[0][2] * m[2][1] - m[0][1] * m[2][2],
                 g = m[0][1] * m[1][2] - m[0][2] * m[1][1];
    const double determinant = m[0][0] * a + m[1][0] * d + m[2][0] * g;
    if (!(fabs(determinant) > 1e-12 * pow(m[0][0], 3)))
        return false;
    for (int k = 0; k < 2; k++)
        out[k] = (b[k][0] * a + b[k][1] * d + b[k][2] * g) / determinant;
    return true;
}

bool metric_velocity(const Cloud *cloud, const double at[2], double velocity[2])
{
    enum { LEAST = 6 };
    const double h = cloud->support_radius;
    double m[3][3] = {{0}}, b[2][3] = {{0}};
    int near = 0;
    for (size_t i = 0; i < cloud->count; i++) {
        const double x = (cloud->position[4 * i] - at[0]) / h, y = (cloud->position[4 * i + 1] - at[1]) / h;
        const double q2 = x * x + y * y;
        if (q2 >= 1)
            continue;
        const double w = pow(1 - sqrt(q2), 3), basis[3] = {1, x, y};
        near++;
        for (int r = 0; r < 3; r++) {
            for (int c = 0; c < 3; c++)
                m[r][c] += w * basis[r] * basis[c];
            for (size_t k = 0; k < 2; k++)
                b[k][r] += w * basis[r] * cloud->velocity[4 * i + k];
        }
    }
    return near >= LEAST && solve_at_origin(m, b, velocity);
}

/* 0 along periodic axes: a mean of wrapped positions has no meaning. */
static void centre_of_mass(const MetricState *state, double out[])
{
    for (int k = 0; k < 3; k++)
        out[k] = state->def->periodic[k] ? 0 : state->sums.centre[k];
}

static void kinetic_energy(const MetricState *state, double out[])
{
    out[0] = state->sums.kinetic_energy;
}

static void potential_energy(const MetricState *state, double out[])
{
    double centre[3];
    centre_of_mass(state, centre);
    out[0] = 0;
    for (int k = 0; k < 3; k++)
        out[0] -= state->sums.mass * state->info.gravity[k] * centre[k];
}

static void angular_momentum(const MetricState *state, double out[])
{
    memcpy(out, state->sums.angular_momentum, sizeof state->sums.angular_momentum);
}

static void max_speed(const MetricState *state, double out[])
{
    out[0] = state->sums.max_speed;
}

static void front(const MetricState *state, double out[])
{
    out[0] = metric_front(&state->cloud);
}

static void height(const MetricState *state, double out[])
{
    out[0] = -INFINITY;
    for (size_t i = 0; i < state->cloud.count; i++)
        out[0] = fmax(out[0], (double)state->cloud.position[4 * i + 1]);
    out[0] = state->cloud.count > 0 ? out[0] + 0.5 * state->cloud.spacing : (double)NAN;
}

static void density_error(const MetricState *state, double out[])
{
    const Cloud *cloud = &state->cloud;
    out[0] = 0;
    for (size_t i = 0; i < cloud->count; i++)
        out[0] += fmax((double)cloud->density[i] / state->def->fluids[cloud->fluid[i]].density - 1, 0) /
                  (double)cloud->count;
}

static void probes(const MetricState *state, double out[])
{
    memcpy(out, state->probe, (size_t)state->probe_count * sizeof *out);
}

int metric_numbers(int metric, int probe_count)
{
    return metric_kinds[metric].numbers ? metric_kinds[metric].numbers : probe_count;
}

const MetricKind metric_kinds[] = {
    {"centre_of_mass", "m", "of all fluid, in the box's frame, but for periodic axes", 3, false,
     centre_of_mass},
    {"kinetic_energy", "J", "of the motion in the box's frame", 1, false, kinetic_energy},
    {"potential_energy", "J", "in gravity, over the box's origin, but for periodic axes", 1, false,
     potential_energy},
    {"angular_momentum", "kg m2/s", "about the box's origin", 3, false, angular_momentum},
    {"max_speed", "m/s", "of the fastest particle", 1, false, max_speed},
    {"front", "m", "greatest x of the fluid on the floor, of particles with neighbours", 1, true, front},
    {"height", "m", "of the highest particle over the floor", 1, true, height},
    {"density_error", "", "mean of what particles are pressed above the rest density, over it", 1, true,
     density_error},
    {"probes", "", "what each of the scene's probes reads, its first number, over its range; their mean", 0,
     true, probes},
    {NULL, NULL, NULL, 0, false, NULL},
};

int metric_defaults(int metrics[])
{
    metrics[0] = 0; /* centre_of_mass */
    metrics[1] = 1; /* kinetic_energy */
    return 2;
}

bool metric_state_read(MetricState *state, const WorldDef *def, World *world, const int metrics[], int count)
{
    bool particles = false;
    for (int m = 0; m < count; m++)
        particles |= metric_kinds[metrics[m]].particles;
    state->def = def;
    world_info(world, &state->info);
    world_sums(world, &state->sums);
    return !particles || cloud_read(&state->cloud, world);
}

void metric_state_free(MetricState *state)
{
    cloud_free(&state->cloud);
}
