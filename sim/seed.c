#include "sim/seed.h"

#include "sim/fill_lattice.h"

#include <math.h>
#include <string.h>

/* A point on a face of a block belongs to it at the low side only, to this part of a spacing. */
static const double slack = 1e-6;

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

/* The solids of a def as they stand at the start. */
typedef struct Stand {
    const WorldDef *def;
    BoxState pose[SOLIDS_MAX];
} Stand;

/* Whether x is clear of all solids, by half a spacing as of the walls. */
static bool is_free(const Stand *stand, const double x[3])
{
    const WorldDef *def = stand->def;
    for (int k = 0; k < def->solid_count; k++) {
        double d[3];
        const double reach = solid_reach(&def->solids[k]) + def->spacing;
        for (int a = 0; a < 3; a++)
            d[a] = x[a] - stand->pose[k].position[a];
        if (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] > reach * reach)
            continue;
        quat_rotate_inverse(stand->pose[k].orientation, d, d);
        if (solid_distance(&def->solids[k], def->dimensions, d) < (0.5 - slack) * def->spacing)
            return false;
    }
    return true;
}

bool fill_holds(const Fill *fill, int dimensions, const double x[3], double tolerance)
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

static bool fill_covers(const WorldDef *def, const Fill *fill, const double x[3])
{
    return fill_holds(fill, def->dimensions, x, slack * def->spacing);
}

/* Whether a fill that stands before fill `index` of fluid `fluid` has the point. */
static bool taken_before(const WorldDef *def, int fluid, int index, const double x[3])
{
    for (int f = 0; f <= fluid; f++)
        for (int i = 0; i < (f == fluid ? index : def->fluids[f].fill_count); i++)
            if (fill_covers(def, &def->fluids[f].fills[i], x))
                return true;
    return false;
}

static size_t seed_fill(const Stand *stand, int fluid, int index, float *position)
{
    const WorldDef *def = stand->def;
    const Fill *fill = &def->fluids[fluid].fills[index];
    FillAxis axes[3];
    size_t count = 0;
    fill_lattice(def, fill, axes);
    const FillAxis *ax = &axes[0], *ay = &axes[1], *az = &axes[2];
    for (long iz = az->begin; iz < az->end; iz++)
        for (long iy = ay->begin; iy < ay->end; iy++)
            for (long ix = ax->begin; ix < ax->end; ix++) {
                const double x[3] = {ax->first + (double)ix * ax->step, ay->first + (double)iy * ay->step,
                                     az->first + (double)iz * az->step};
                const double at[3] = {ax->place + (double)ix * ax->advance,
                                      ay->place + (double)iy * ay->advance,
                                      az->place + (double)iz * az->advance};
                if (!fill_covers(def, fill, x) || taken_before(def, fluid, index, x) || !is_free(stand, at))
                    continue;
                for (size_t k = 0; position && k < 3; k++)
                    position[3 * count + k] = (float)at[k];
                count++;
            }
    return count;
}

static void stand_make(const WorldDef *def, Stand *stand)
{
    stand->def = def;
    for (int k = 0; k < def->solid_count; k++)
        solid_pose(&def->solids[k], 0, &stand->pose[k]);
}

void seed_counts(const WorldDef *def, size_t counts[FLUIDS_MAX])
{
    Stand stand;
    stand_make(def, &stand);
    for (int f = 0; f < def->fluid_count; f++) {
        counts[f] = 0;
        for (int i = 0; i < def->fluids[f].fill_count; i++)
            counts[f] += seed_fill(&stand, f, i, NULL);
    }
}

size_t seed_lattice(const WorldDef *def, float *position, uint8_t *fluid)
{
    size_t count = 0;
    Stand stand;
    stand_make(def, &stand);
    for (int f = 0; f < def->fluid_count; f++)
        for (int i = 0; i < def->fluids[f].fill_count; i++) {
            const size_t added = seed_fill(&stand, f, i, position ? position + 3 * count : NULL);
            if (fluid)
                memset(fluid + count, f, added);
            count += added;
        }
    return count;
}

/* A number in [-1, 1) that point and axis decide: M. Nobile's mix of 32 bits, "lowbias32". */
static double scatter(uint32_t point, uint32_t axis)
{
    uint32_t bits = point * 3 + axis + 1;
    bits = (bits ^ bits >> 16) * 0x7feb352dU;
    bits = (bits ^ bits >> 15) * 0x846ca68bU;
    return (double)((bits ^ bits >> 16) >> 8) * 0x1p-23 - 1;
}

void seed_jitter(const WorldDef *def, float *position, size_t count)
{
    for (size_t i = 0; i < count; i++)
        for (uint32_t k = 0; k < (uint32_t)def->dimensions; k++)
            position[3 * i + k] += (float)(def->jitter * def->spacing * scatter((uint32_t)i, k));
}
