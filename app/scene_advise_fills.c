/* What fills became: particles of a lattice. */
#include "app/scene_advise.h"
#include "sim/seed.h"
#include "sim/solid.h"

#include <math.h>
#include <stdio.h>

enum { LAYERS_FEW = 4 };

static const double mass_off = 1e-3; /* what is not worth a line */

static bool bounds_meet(const WorldDef *world, const double low[3], const double high[3], const Fill *other)
{
    double a[3], b[3];
    fill_bounds(other, a, b);
    for (int k = 0; k < world->dimensions; k++)
        if (fmax(low[k], a[k]) > fmin(high[k], b[k]) - 1e-9 * world->spacing)
            return false;
    return true;
}

static bool meets_solid(const WorldDef *world, const double low[3], const double high[3])
{
    for (int s = 0; s < world->solid_count; s++) {
        const double reach = solid_reach(&world->solids[s]) + world->spacing;
        bool apart = false;
        for (int k = 0; k < world->dimensions; k++)
            apart |=
                world->solids[s].centre[k] + reach < low[k] || world->solids[s].centre[k] - reach > high[k];
        if (!apart)
            return true;
    }
    return false;
}

/* What the fills of a fluid hold, m3 or m2; 0: they share their place with other fills or solids, and nobody
   has said. */
static double volume_of(const WorldDef *world, int f)
{
    double volume = 0;
    for (int i = 0; i < world->fluids[f].fill_count; i++) {
        const Fill *fill = &world->fluids[f].fills[i];
        double low[3], high[3];
        fill_bounds(fill, low, high);
        for (int g = 0; g < world->fluid_count; g++)
            for (int j = 0; j < world->fluids[g].fill_count; j++)
                if ((g != f || j != i) && bounds_meet(world, low, high, &world->fluids[g].fills[j]))
                    return 0;
        if (meets_solid(world, low, high))
            return 0;
        volume += fill_volume(fill, world->dimensions);
    }
    return volume;
}

static void advise_mass(const Tree *tree, const WorldDef *world, int f, size_t count, Notes *notes)
{
    const double volume = volume_of(world, f), is = (double)count * pow(world->spacing, world->dimensions);
    char path[64];
    snprintf(path, sizeof path, "fluids[%d].fill", f);
    if (count > 1 && volume > 0 && fabs(is / volume - 1) > mass_off)
        advise(tree, path, notes,
               "'%s' has %+.2f %% of what its fills hold: %zu particles on a lattice; a smaller "
               "particles.spacing is nearer",
               world->fluids[f].name, 100 * (is / volume - 1), count);
}

static void advise_thin(const Tree *tree, const WorldDef *world, int f, Notes *notes)
{
    for (int i = 0; i < world->fluids[f].fill_count; i++) {
        const Fill *fill = &world->fluids[f].fills[i];
        double least = INFINITY;
        char path[64];
        for (int k = 0; k < world->dimensions; k++)
            least = fmin(least, fill->max[k] - fill->min[k]);
        snprintf(path, sizeof path, "fluids[%d].fill[%d].block", f, i);
        if (fill->kind == FILL_BLOCK && least < (LAYERS_FEW - 0.5) * world->spacing)
            advise(tree, path, notes,
                   "the block is %.2g spacings thick: too few particles to flow like a fluid; a "
                   "particles.spacing of %.2g m has %d layers",
                   least / world->spacing, least / LAYERS_FEW, LAYERS_FEW);
    }
}

void advise_fills(const Tree *tree, const Scene *scene, Notes *notes)
{
    const WorldDef *world = &scene->world;
    size_t counts[FLUIDS_MAX];
    if (!tree || !notes) /* of the start alone */
        return;
    seed_counts(world, counts);
    for (int f = 0; f < world->fluid_count; f++) {
        advise_mass(tree, world, f, counts[f], notes);
        advise_thin(tree, world, f, notes);
    }
}
