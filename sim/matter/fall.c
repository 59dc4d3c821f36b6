#include "sim/matter/fall.h"

#include <math.h>

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
