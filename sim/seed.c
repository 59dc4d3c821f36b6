#include "sim/seed.h"

#include <math.h>

/* A point on a face of a block belongs to it at the low side only, to this part of a spacing. */
static const double slack = 1e-6;

double fill_volume(const Fill *fill)
{
    if (fill->kind == FILL_BALL)
        return 4 * M_PI / 3 * fill->radius * fill->radius * fill->radius;
    return (fill->max[0] - fill->min[0]) * (fill->max[1] - fill->min[1]) * (fill->max[2] - fill->min[2]);
}

static bool fill_covers(const Fill *fill, const double x[3], double tolerance)
{
    if (fill->kind == FILL_BLOCK) {
        for (int k = 0; k < 3; k++)
            if (x[k] < fill->min[k] - tolerance || x[k] >= fill->max[k] - tolerance)
                return false;
        return true;
    }
    double r2 = 0;
    for (int k = 0; k < 3; k++)
        r2 += (x[k] - fill->centre[k]) * (x[k] - fill->centre[k]);
    return r2 <= fill->radius * fill->radius;
}

static int fluid_at(const WorldDef *def, const double x[3])
{
    for (int f = 0; f < def->fluid_count; f++)
        for (int i = 0; i < def->fluids[f].fill_count; i++)
            if (fill_covers(&def->fluids[f].fills[i], x, slack * def->spacing))
                return f;
    return -1;
}

/* Range of lattice indices that some fill may cover; the point of index i lies at first + i * spacing. */
typedef struct Axis {
    double first;
    long begin, end;
} Axis;

static Axis lattice_axis(const WorldDef *def, int k)
{
    const double s = def->spacing;
    const double points = floor(def->box_size[k] / s + slack);
    Axis axis = {.first = k == 1 ? 0.5 * s : -0.5 * (points - 1) * s};
    double low = INFINITY, high = -INFINITY;
    for (int f = 0; f < def->fluid_count; f++)
        for (int i = 0; i < def->fluids[f].fill_count; i++) {
            const Fill *fill = &def->fluids[f].fills[i];
            const bool ball = fill->kind == FILL_BALL;
            low = fmin(low, ball ? fill->centre[k] - fill->radius : fill->min[k]);
            high = fmax(high, ball ? fill->centre[k] + fill->radius : fill->max[k]);
        }
    if (low > high)
        return axis;
    axis.begin = (long)fmax(0, floor((low - axis.first) / s));
    axis.end = (long)fmin(points, ceil((high - axis.first) / s) + 1);
    return axis;
}

size_t seed_lattice(const WorldDef *def, float *position, uint8_t *fluid)
{
    Axis axis[3];
    for (int k = 0; k < 3; k++)
        axis[k] = lattice_axis(def, k);

    size_t count = 0;
    for (long iz = axis[2].begin; iz < axis[2].end; iz++)
        for (long iy = axis[1].begin; iy < axis[1].end; iy++)
            for (long ix = axis[0].begin; ix < axis[0].end; ix++) {
                const double s = def->spacing;
                const double x[3] = {axis[0].first + (double)ix * s, axis[1].first + (double)iy * s,
                                     axis[2].first + (double)iz * s};
                const int f = fluid_at(def, x);
                if (f < 0)
                    continue;
                if (position) {
                    for (int k = 0; k < 3; k++)
                        position[3 * count + (size_t)k] = (float)x[k];
                    fluid[count] = (uint8_t)f;
                }
                count++;
            }
    return count;
}
