#include "sim/start/start.h"

#include "sim/base/base.h"

#include <math.h>
#include <string.h>

/* Fraction of a spacing: a point on a face of a block belongs to the block at the low side only. */
static const double slack = 1e-6;

/* Groups of fills and solids of a def at the start. */
typedef struct Start {
    const WorldDef *def;
    BoxState pose[SOLIDS_MAX];
    bool cut; /* a height by formula cuts a fill: then no pile decides about points */
    FillGroups groups;
} Start;

/* True if x is at least half a spacing away from all solids, as from walls. */
static bool is_free(const Start *start, const double x[3])
{
    const WorldDef *def = start->def;
    for (int k = 0; k < def->solid_count; k++) {
        double d[3];
        const double reach = solid_reach(&def->solids[k]) + def->spacing;
        for (int a = 0; a < 3; a++)
            d[a] = x[a] - start->pose[k].position[a];
        if (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] > reach * reach)
            continue;
        quat_rotate_inverse(start->pose[k].orientation, d, d);
        if (solid_distance(&def->solids[k], def->dimensions, d) < (0.5 - slack) * def->spacing)
            return false;
    }
    return true;
}

static bool fill_covers(const WorldDef *def, const Fill *fill, const double x[3])
{
    return fill_holds(fill, def->dimensions, x, slack * def->spacing);
}

/* True if a fill before fill `index` of fluid `fluid` has the point. */
static bool taken_before(const WorldDef *def, int fluid, int index, const double x[3])
{
    for (int f = 0; f <= fluid; f++)
        for (int i = 0; i < (f == fluid ? index : def->fluids[f].fill_count); i++)
            if (fill_covers(def, &def->fluids[f].fills[i], x))
                return true;
    return false;
}

/* `pile`: NULL if the fill is in no pile. */
static bool has_point(const WorldDef *def, const FillPile *pile, int fluid, int index, const double x[3],
                      const long layer[3])
{
    const Fill *fill = &def->fluids[fluid].fills[index], *owner = pile ? fill_pile_owner(pile, layer) : NULL;
    return owner ? owner == fill : fill_covers(def, fill, x) && !taken_before(def, fluid, index, x);
}

static bool is_cut(const WorldDef *def)
{
    for (int f = 0; f < def->fluid_count; f++)
        for (int i = 0; i < def->fluids[f].fill_count; i++)
            if (formula_given(def->fluids[f].fills[i].below))
                return true;
    return false;
}

/* True for two blocks without a common point. */
static bool blocks_apart(const Fill *a, const Fill *b, int dimensions)
{
    for (int k = 0; k < dimensions && a->kind == FILL_BLOCK && b->kind == FILL_BLOCK; k++)
        if (a->max[k] <= b->min[k] || b->max[k] <= a->min[k])
            return true;
    return false;
}

/* True if only the block's range along each axis decides about a point of the fill. */
static bool is_plain_block(const WorldDef *def, int fluid, int index)
{
    const Fill *fill = &def->fluids[fluid].fills[index];
    for (int f = 0; f <= fluid; f++)
        for (int i = 0; i < (f == fluid ? index : def->fluids[f].fill_count); i++)
            if (!blocks_apart(fill, &def->fluids[f].fills[i], def->dimensions))
                return false;
    return fill->kind == FILL_BLOCK && !formula_given(fill->below) && def->solid_count == 0;
}

/* Number of points of a plain block: the product of the numbers along each axis. */
static size_t block_count(const WorldDef *def, const Fill *block, const FillAxis axes[3])
{
    size_t count = 1;
    for (int k = 0; k < 3; k++) {
        size_t along = 0;
        double x[3];
        for (int a = 0; a < 3; a++)
            x[a] = block->min[a] - slack * def->spacing; /* inside */
        for (long i = axes[k].begin; i < axes[k].end; i++) {
            x[k] = axes[k].first + (double)i * axes[k].step;
            along += fill_covers(def, block, x);
        }
        count *= along;
    }
    return count;
}

/* `number`: of the fill among all fills. */
static size_t seed_fill(const Start *start, int fluid, int index, int number, float *position)
{
    const WorldDef *def = start->def;
    const Fill *fill = &def->fluids[fluid].fills[index];
    FillAxis axes[3];
    FillPile piled;
    size_t count = 0;
    fill_lattice(def, &start->groups, number, axes);
    const FillPile *pile =
        !start->cut && fill_pile(def, &start->groups, number, axes, &piled) ? &piled : NULL;
    if (!position && !pile && is_plain_block(def, fluid, index))
        return block_count(def, fill, axes);
    const int row = position ? 0 : 1, rows = 1 - row; /* a count goes up columns, for the cached heights of
                                                         sim/start/fill.c */
    long i[3];
    for (i[2] = axes[2].begin; i[2] < axes[2].end; i[2]++)
        for (i[rows] = axes[rows].begin; i[rows] < axes[rows].end; i[rows]++)
            for (i[row] = axes[row].begin; i[row] < axes[row].end; i[row]++) {
                double x[3], at[3];
                for (int k = 0; k < 3; k++) {
                    x[k] = axes[k].first + (double)i[k] * axes[k].step;
                    at[k] = axes[k].place + (double)i[k] * axes[k].advance;
                }
                if (!has_point(def, pile, fluid, index, x, i) || !is_free(start, at))
                    continue;
                for (size_t k = 0; position && k < 3; k++)
                    position[3 * count + k] = (float)at[k];
                count++;
            }
    return count;
}

/* True if some point of the column at x[0], x[2] is in the shape; x[1] becomes the height of the point. */
static bool column_covered(const WorldDef *def, const Fill *shape, const FillAxis axes[3], double x[3])
{
    for (long i = axes[1].begin; i < axes[1].end; i++) {
        x[1] = axes[1].first + (double)i * axes[1].step;
        if (fill_covers(def, shape, x))
            return true;
    }
    return false;
}

/* True if the fill's height is not finite over a point of the fill. */
static bool lacks_height(const WorldDef *def, const Fill *fill, const FillAxis axes[3], double at[2])
{
    Fill shape = *fill;
    shape.below = NULL;
    shape.heights = NULL;
    for (long k = axes[2].begin; k < axes[2].end; k++)
        for (long i = axes[0].begin; i < axes[0].end; i++) {
            double x[3] = {axes[0].first + (double)i * axes[0].step, 0,
                           axes[2].first + (double)k * axes[2].step},
                   y;
            if (!fill_ends(fill, x[0], x[2], &y) || isfinite(y) || !column_covered(def, &shape, axes, x))
                continue;
            at[0] = x[0], at[1] = x[2];
            return true;
        }
    return false;
}

bool seed_lacks_height(const WorldDef *def, int *fluid, int *index, double at[2])
{
    FillGroups groups;
    int number = 0;
    fill_groups(def, &groups);
    for (*fluid = 0; *fluid < def->fluid_count; ++*fluid)
        for (*index = 0; *index < def->fluids[*fluid].fill_count; ++*index, number++) {
            const Fill *fill = groups.fill[number];
            FillAxis axes[3];
            if (!formula_given(fill->below))
                continue;
            fill_lattice(def, &groups, number, axes);
            if (lacks_height(def, fill, axes, at))
                return true;
        }
    return false;
}

static void start_make(const WorldDef *def, Start *start)
{
    start->def = def;
    start->cut = is_cut(def);
    for (int k = 0; k < def->solid_count; k++)
        solid_pose(&def->solids[k], 0, &start->pose[k]);
    fill_groups(def, &start->groups);
}

void seed_counts(const WorldDef *def, size_t counts[FLUIDS_MAX])
{
    Start start;
    int number = 0;
    start_make(def, &start);
    for (int f = 0; f < def->fluid_count; f++) {
        counts[f] = 0;
        for (int i = 0; i < def->fluids[f].fill_count; i++)
            counts[f] += seed_fill(&start, f, i, number++, NULL);
    }
}

size_t seed_lattice(const WorldDef *def, float *position, uint8_t *fluid)
{
    size_t count = 0;
    Start start;
    int number = 0;
    start_make(def, &start);
    for (int f = 0; f < def->fluid_count; f++)
        for (int i = 0; i < def->fluids[f].fill_count; i++) {
            const size_t added = seed_fill(&start, f, i, number++, position ? position + 3 * count : NULL);
            if (fluid)
                memset(fluid + count, f, added);
            count += added;
        }
    return count;
}

/* A number in [-1, 1) from point and axis. */
static double scatter(uint32_t point, uint32_t axis)
{
    return (double)(hash_mix(point * 3 + axis + 1) >> 8) * 0x1p-23 - 1;
}

void seed_jitter(const WorldDef *def, float *position, size_t count)
{
    for (size_t i = 0; i < count; i++)
        for (uint32_t k = 0; k < (uint32_t)def->dimensions; k++)
            position[3 * i + k] += (float)(def->jitter * def->spacing * scatter((uint32_t)i, k));
}

size_t seed_count(const WorldDef *def, double spacing)
{
    double volume = 0;
    for (int k = 0; k < def->dimensions; k++)
        if (def->box_size[k] / spacing > 1e7)
            return SIZE_MAX;
    WorldDef at = *def;
    at.spacing = spacing;
    for (int k = 0; k < at.solid_count; k++)
        if (at.solids[k].thickness == 0)
            at.solids[k].thickness = at.support * spacing;
    for (int f = 0; f < def->fluid_count; f++)
        for (int i = 0; i < def->fluids[f].fill_count; i++)
            volume += fill_volume(&def->fluids[f].fills[i], def->dimensions);
    if (volume / pow(spacing, def->dimensions) > 0x1p32)
        return SIZE_MAX;
    return seed_lattice(&at, NULL, NULL);
}

/* Height of x against gravity, m above the box's origin; 0 without gravity. */
static double height_of(const double gravity[3], const double x[3])
{
    double sum = 0, length = 0;
    for (int k = 0; k < 3; k++) {
        sum -= gravity[k] * x[k];
        length += gravity[k] * gravity[k];
    }
    return length > 0 ? sum / sqrt(length) : 0;
}

/* Greatest height of a block's corners for sign > 0, least for sign < 0, m. */
static double block_height(const double gravity[3], const double min[3], const double max[3], double sign)
{
    double corner[3];
    for (int k = 0; k < 3; k++)
        corner[k] = (gravity[k] < 0) == (sign > 0) ? max[k] : min[k];
    return height_of(gravity, corner);
}

static double fill_top(const WorldDef *def, const Fill *fill, const double low[3], const double high[3])
{
    double min[3], max[3];
    for (int k = 0; k < 3; k++) {
        const double reach = fill->kind == FILL_MESH
                                 ? mesh_use_reach(&fill->mesh)
                                 : fill->radius + (fill->kind == FILL_CYLINDER ? 0.5 * fill->height : 0);
        const bool block = fill->kind == FILL_BLOCK;
        min[k] = fmax(low[k], block ? fill->min[k] : fill->centre[k] - reach);
        max[k] = fmin(high[k], block ? fill->max[k] : fill->centre[k] + reach);
    }
    return block_height(def->gravity, min, max, 1);
}

double greatest_fall(const WorldDef *def)
{
    double low[3], high[3], top = -INFINITY;
    for (int k = 0; k < 3; k++) {
        low[k] = k == 1 ? 0 : -0.5 * def->box_size[k];
        high[k] = low[k] + def->box_size[k];
    }
    const double bottom = block_height(def->gravity, low, high, -1);
    for (int f = 0; f < def->fluid_count; f++) {
        const FluidDef *fluid = &def->fluids[f];
        for (int i = 0; i < fluid->fill_count; i++)
            top = fmax(top, fill_top(def, &fluid->fills[i], low, high));
        for (int i = 0; i < fluid->emit_count; i++)
            top = fmax(top, height_of(def->gravity, fluid->emits[i].centre));
    }
    return fmax(top - bottom, 0);
}

double vortices_add(const WorldDef *def, const FluidDef *fluid, const float x[3], float v[3])
{
    const double u = fluid->taylor_green, kx = 2 * M_PI / def->box_size[0], ky = 2 * M_PI / def->box_size[1];
    const double a = kx * (double)x[0], b = ky * (double)x[1], ratio = kx / ky;
    v[0] += (float)(-u * cos(a) * sin(b));
    v[1] += (float)(u * ratio * sin(a) * cos(b));
    return -0.25 * fluid->density * u * u * (cos(2 * a) + ratio * ratio * cos(2 * b));
}

bool vortices_any(const WorldDef *def)
{
    bool any = false;
    for (int f = 0; f < def->fluid_count; f++)
        any |= def->fluids[f].taylor_green != 0;
    return any;
}
