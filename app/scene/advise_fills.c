/* Checks the lattice of particles made from fills. */
#include "app/scene/advise.h"
#include "sim/base/formula.h"
#include "sim/matter/balance.h"
#include "sim/matter/fill.h"
#include "sim/matter/seed.h"
#include "sim/matter/solid.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { LAYERS_FEW = 4 };

/* Relative mass errors not worth a line; balls and cylinders never match a lattice to the last particle. */
static const double mass_off = 1e-3, mass_off_round = 1e-2;

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

/* Volume of a fluid's fills, m3 or m2; 0 if unknown: fills that overlap fills or solids, or that end at a
   formula. */
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
        if (meets_solid(world, low, high) || formula_given(fill->below))
            return 0;
        volume += fill_volume(fill, world->dimensions);
    }
    return volume;
}

static double mass_off_of(const FluidDef *fluid)
{
    for (int i = 0; i < fluid->fill_count; i++)
        if (fluid->fills[i].kind != FILL_BLOCK)
            return mass_off_round;
    return mass_off;
}

static void advise_mass(const Tree *tree, const WorldDef *world, int f, size_t count, Notes *notes)
{
    const FluidDef *fluid = &world->fluids[f];
    const double volume = volume_of(world, f),
                 more = volume > 0 ? (double)count * pow(world->spacing, world->dimensions) / volume - 1 : 0;
    char path[64];
    snprintf(path, sizeof path, "fluids[%d].fill", f);
    if (count > 1 && fabs(more) > mass_off_of(fluid))
        advise(tree, path, notes,
               "'%s' has %.2g %% %s mass than its fills: %zu particles on a lattice; a smaller "
               "particles.spacing comes nearer",
               fluid->name, 100 * fabs(more), more > 0 ? "more" : "less", count);
}

/* Thickness of a block along its thinnest and its longest axis, in spacings. */
static void thickness(const WorldDef *world, const Fill *block, double *least, double *most)
{
    *least = INFINITY;
    *most = 0;
    for (int k = 0; k < world->dimensions; k++) {
        const double thick = (block->max[k] - block->min[k]) / world->spacing;
        *least = fmin(*least, thick);
        *most = fmax(*most, thick);
    }
}

/* Warns of thin blocks, except a block of a single particle, which is surely intended. */
static void advise_thin(const Tree *tree, const WorldDef *world, int f, Notes *notes)
{
    for (int i = 0; i < world->fluids[f].fill_count; i++) {
        const Fill *fill = &world->fluids[f].fills[i];
        double least, most;
        char path[64], thick[32];
        thickness(world, fill, &least, &most);
        snprintf(path, sizeof path, "fluids[%d].fill[%d].block", f, i);
        snprintf(thick, sizeof thick, "%.2g", least);
        if (fill->kind == FILL_BLOCK && most >= 1.5 && least < LAYERS_FEW - 0.5)
            advise(tree, path, notes,
                   "the block is %s spacing%s thick: too few particles to flow like a fluid; a "
                   "particles.spacing of %.2g m has %d layers",
                   thick, strcmp(thick, "1") == 0 ? "" : "s", least * world->spacing / LAYERS_FEW,
                   LAYERS_FEW);
    }
}

/* Warns if the fluid extends beyond the table: edge values apply there. */
static void advise_beyond(const Tree *tree, const char *path, const WorldDef *world, const FieldTable *table,
                          const double low[3], const double high[3], Notes *notes)
{
    for (int k = 0; k < 3; k++) {
        if (k >= world->dimensions || table->count[k] < 2)
            continue; /* no dependence on this axis */
        const double first = table->place[k][0], last = table->place[k][table->count[k] - 1];
        /* the outermost particles are half a spacing from the faces */
        if (low[k] + 0.5 * world->spacing < first - 1e-6 * world->spacing ||
            high[k] - 0.5 * world->spacing > last + 1e-6 * world->spacing)
            advise(tree, path, notes,
                   "the table reaches from %g to %g m in %c, and the fluid from %g to %g m: beyond the table "
                   "it has what stands at its edge",
                   first, last, "xyz"[k], low[k], high[k]);
    }
}

static void advise_tables(const Tree *tree, const WorldDef *world, int f, Notes *notes)
{
    const FluidDef *fluid = &world->fluids[f];
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    char path[64];
    for (int i = 0; i < fluid->fill_count; i++) {
        double a[3], b[3];
        fill_bounds(&fluid->fills[i], a, b);
        snprintf(path, sizeof path, "fluids[%d].fill[%d].below", f, i);
        if (fluid->fills[i].heights)
            advise_beyond(tree, path, world, fluid->fills[i].heights, a, b, notes);
        for (int k = 0; k < 3; k++) {
            low[k] = fmin(low[k], a[k]);
            high[k] = fmax(high[k], b[k]);
        }
    }
    snprintf(path, sizeof path, "fluids[%d].velocity_table", f);
    if (fluid->flow_table)
        advise_beyond(tree, path, world, fluid->flow_table, low, high, notes);
}

static void advise_start(const Tree *tree, const WorldDef *world, const size_t counts[FLUIDS_MAX],
                         Notes *notes)
{
    size_t count = 0;
    bool hydrostatic = false;
    for (int f = 0; f < world->fluid_count; f++) {
        count += counts[f];
        hydrostatic |= world->fluids[f].start == START_HYDROSTATIC;
    }
    if (hydrostatic && count > BALANCE_MOST)
        advise(tree, "particles.spacing", notes,
               "%zu particles start at rest, not in balance: that is for %d at most", count, BALANCE_MOST);
}

/* Warns of a single particle without emitters. */
static void advise_lone(const Tree *tree, const WorldDef *world, const size_t counts[], Notes *notes)
{
    size_t count = 0;
    bool more = false;
    for (int f = 0; f < world->fluid_count; f++) {
        count += counts[f];
        more |= world->fluids[f].emit_count > 0;
    }
    if (count == 1 && !more)
        advise(tree, "fluids", notes,
               "one particle has no neighbours: nothing presses it, and it falls like a stone; use a smaller "
               "spacing, or larger fills");
}

void advise_fills(const Tree *tree, const Scene *scene, Notes *notes)
{
    const WorldDef *world = &scene->world;
    size_t counts[FLUIDS_MAX];
    if (!tree || !notes) /* for the start only */
        return;
    seed_counts(world, counts);
    advise_start(tree, world, counts, notes);
    advise_lone(tree, world, counts, notes);
    for (int f = 0; f < world->fluid_count; f++) {
        advise_mass(tree, world, f, counts[f], notes);
        advise_thin(tree, world, f, notes);
        advise_tables(tree, world, f, notes);
    }
}
