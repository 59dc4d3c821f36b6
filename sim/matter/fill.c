#include "sim/matter/fill.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

double fill_volume(const Fill *fill, int dimensions)
{
    const double r = fill->radius, depth = dimensions == 3 ? fill->max[2] - fill->min[2] : 1;
    if (fill->kind == FILL_CYLINDER)
        return M_PI * r * r * fill->height;
    if (fill->kind == FILL_BALL)
        return dimensions == 3 ? 4 * M_PI / 3 * r * r * r : M_PI * r * r;
    return (fill->max[0] - fill->min[0]) * (fill->max[1] - fill->min[1]) * depth;
}

void fill_bounds(const Fill *fill, double low[3], double high[3])
{
    const double *a = fill->axis, length2 = a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
    for (int k = 0; k < 3; k++) {
        if (fill->kind == FILL_BLOCK) {
            low[k] = fill->min[k];
            high[k] = fill->max[k];
            continue;
        }
        double reach = fill->radius;
        if (fill->kind == FILL_CYLINDER) {
            const double along2 = a[k] * a[k] / length2;
            reach = 0.5 * fill->height * sqrt(along2) + fill->radius * sqrt(fmax(0, 1 - along2));
        }
        low[k] = fill->centre[k] - reach;
        high[k] = fill->centre[k] + reach;
    }
}

static bool cylinder_holds(const Fill *fill, const double x[3])
{
    double r2 = 0, along = 0, length2 = 0;
    for (int k = 0; k < 3; k++) {
        const double d = x[k] - fill->centre[k];
        r2 += d * d;
        along += d * fill->axis[k];
        length2 += fill->axis[k] * fill->axis[k];
    }
    const double along2 = along * along / length2;
    return along2 <= 0.25 * fill->height * fill->height && r2 - along2 <= fill->radius * fill->radius;
}

/* A formula's values: rows of a lattice, one above the other, ask for the same ones. */
enum { HEIGHTS = 8192 };
typedef struct Heights {
    char below[FORMULA_SIZE];
    double at[HEIGHTS][3]; /* x, z, height */
    bool known[HEIGHTS];
} Heights;

static size_t height_slot(double x, double z)
{
    uint64_t bits[2];
    memcpy(bits, (double[]){x, z}, sizeof bits);
    return (size_t)((bits[0] * 0x9e3779b97f4a7c15U ^ bits[1] * 0xc2b2ae3d27d4eb4fU) >> 40) % HEIGHTS;
}

bool fill_ends(const Fill *fill, double x, double z, double *y)
{
    static _Thread_local Heights heights;
    const size_t slot = height_slot(x, z);
    double *at = heights.at[slot];
    Error error;
    if (!formula_given(fill->below))
        return false;
    if (strcmp(heights.below, fill->below) != 0) {
        memset(heights.known, 0, sizeof heights.known);
        memcpy(heights.below, fill->below, sizeof heights.below);
    }
    if (!heights.known[slot] || at[0] != x || at[1] != z) {
        heights.known[slot] = formula_value(fill->below, "xz", (double[]){x, z}, &at[2], &error);
        at[0] = x, at[1] = z;
    }
    *y = at[2];
    return heights.known[slot];
}

static bool shape_holds(const Fill *fill, int dimensions, const double x[3], double tolerance)
{
    const int axes = dimensions == 2 ? 2 : 3;
    if (fill->kind == FILL_BLOCK) {
        for (int k = 0; k < axes; k++)
            if (x[k] < fill->min[k] - tolerance || x[k] >= fill->max[k] - tolerance)
                return false;
        return true;
    }
    if (fill->kind == FILL_CYLINDER)
        return cylinder_holds(fill, x);
    double r2 = 0;
    for (int k = 0; k < axes; k++)
        r2 += (x[k] - fill->centre[k]) * (x[k] - fill->centre[k]);
    return r2 <= fill->radius * fill->radius;
}

bool fill_holds(const Fill *fill, int dimensions, const double x[3], double tolerance)
{
    double end; /* a formula is dear: last */
    return shape_holds(fill, dimensions, x, tolerance) && (!fill_ends(fill, x[0], x[2], &end) || x[1] < end);
}
