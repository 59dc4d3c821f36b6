/* Lists of a def or a solid for tests: added to and changed one by one; they last as long as the test
   program. */
#ifndef SLOSH_TEST_LISTS_H
#define SLOSH_TEST_LISTS_H

#include "sim/def.h"

#include <stdlib.h>
#include <string.h>

/* A copy of the list, to change, with room for one more. */
static inline void *list_own(const void *list, int count, size_t size)
{
    struct Block {
        struct Block *next;
        _Alignas(16) char bytes[];
    };
    static struct Block *blocks; /* for leak checkers */
    struct Block *block = calloc(1, sizeof *block + (size_t)(count + 1) * size);
    if (!block)
        abort();
    block->next = blocks;
    blocks = block;
    if (count > 0)
        memcpy(block->bytes, list, (size_t)count * size);
    return block->bytes;
}

/* The lists to change. */
static inline Fill *own_fills(FluidDef *fluid)
{
    Fill *fills = list_own(fluid->fills, fluid->fill_count, sizeof *fills);
    fluid->fills = fills;
    return fills;
}

static inline Emit *own_emits(FluidDef *fluid)
{
    Emit *emits = list_own(fluid->emits, fluid->emit_count, sizeof *emits);
    fluid->emits = emits;
    return emits;
}

static inline Motion *own_motions(WorldDef *def)
{
    Motion *motions = list_own(def->motions, def->motion_count, sizeof *motions);
    def->motions = motions;
    return motions;
}

/* These add at the end, and return what was added, to change. */
static inline Fill *add_fill(FluidDef *fluid, Fill fill)
{
    Fill *fills = own_fills(fluid);
    fills[fluid->fill_count] = fill;
    return &fills[fluid->fill_count++];
}

static inline Emit *add_emit(FluidDef *fluid, Emit emit)
{
    Emit *emits = own_emits(fluid);
    emits[fluid->emit_count] = emit;
    return &emits[fluid->emit_count++];
}

static inline Fill *add_drain(WorldDef *def, Fill drain)
{
    Fill *drains = list_own(def->drains, def->drain_count, sizeof *drains);
    def->drains = drains;
    drains[def->drain_count] = drain;
    return &drains[def->drain_count++];
}

static inline Motion *add_motion(WorldDef *def, Motion motion)
{
    Motion *motions = own_motions(def);
    motions[def->motion_count] = motion;
    return &motions[def->motion_count++];
}

static inline Motion *add_solid_motion(SolidDef *solid, Motion motion)
{
    Motion *motions = list_own(solid->motions, solid->motion_count, sizeof *motions);
    solid->motions = motions;
    motions[solid->motion_count] = motion;
    return &motions[solid->motion_count++];
}

#endif
