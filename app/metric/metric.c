#include "app/metric/metric.h"

#include "sim/world/method.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

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
    static size_t top[CELLS][CELLS]; /* index + 1 of the highest particle */
    Curve all = {.count = 0};
    const int n = (int)fmin(width / cloud->spacing + 0.5, CELLS);
    memset(top, 0, sizeof top);
    for (size_t i = 0; i < cloud->count; i++) {
        const float *x = cloud->position + 4 * i;
        const int a = (int)floor((x[0] / width + 0.5) * n), b = (int)floor((x[2] / width + 0.5) * n);
        if (a > 0 && a < n - 1 && b > 0 && b < n - 1 &&
            (!top[a][b] || x[1] > cloud->position[4 * (top[a][b] - 1) + 1]))
            top[a][b] = i + 1;
    }
    for (int cell = 0; cell < n * n; cell++) {
        if (!top[cell / n][cell % n])
            continue;
        const float *x = cloud->position + 4 * (top[cell / n][cell % n] - 1);
        const double r2 = (double)x[0] * x[0] + (double)x[2] * x[2];
        curve_add(&all, r2, x[1]);
        if (points)
            curve_add(points, sqrt(r2), x[1] + 0.5 * cloud->spacing);
    }
    const double slope = curve_slope(&all);
    curve_free(&all);
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
