/* The walk over neighbours, shared by all pair loops. For files compiled for each instruction set.

   LANES particles walk their lists side by side, a lane each. A particle's sum follows the order of its
   list at any width, and no sum over lanes is needed. */
#ifndef SLOSH_WALK_H
#define SLOSH_WALK_H

#include "sim/cpu/simd.h"

/* GROUPS (i, begin, end) { ... }: for each group of LANES particles i, i + 1, ... that overlaps [begin,
   end). */
#define GROUPS(i, begin, end) for (size_t i = (begin) / LANES * LANES; i < (end); i += LANES)

/* Stores results of group i within [begin, end): the rest of the group may belong to a different thread. */
SIMD_INLINE void lanes_store(float *column, size_t i, size_t begin, size_t end, f8 value)
{
    if (i >= begin && i + LANES <= end)
        f8_store(column + i, value);
    else
        for (size_t k = 0; k < LANES; k++)
            if (i + k >= begin && i + k < end)
                column[i + k] = value[k];
}

SIMD_INLINE void lanes_add(float *column, size_t i, size_t begin, size_t end, f8 value)
{
    lanes_store(column, i, begin, end, f8_load(column + i) + value);
}

/* Positions of a group's particles. */
typedef struct Place {
    f8 x, y, z;
} Place;

SIMD_INLINE Place place_of(const PairArgs *args, size_t i)
{
    return (Place){f8_load(args->x + i), f8_load(args->y + i), f8_load(args->z + i)};
}

/* The lists of a group. */
typedef struct Near {
    const uint32_t *first, *end;
    bool coincident; /* some particle of the group nearly coincides with a neighbour */
} Near;

SIMD_INLINE Near near_of(const PairArgs *args, size_t i)
{
    const NeighbourLists *lists = args->lists;
    const uint32_t *first = lists->of_range[i / LISTS_GRAIN].index + lists->first[i / LANES],
                   rows = lists->rows[i / LANES];
    return (Near){first, first + LANES * (rows & ~(uint32_t)LISTS_COINCIDENT),
                  (rows & LISTS_COINCIDENT) != 0};
}

/* NEIGHBOURS (near, j) { const Separation d = separation(args, at, j); ... }: for the next neighbour of
   each lane; j points to the neighbours' indices. */
#define NEIGHBOURS(near, j) for (const uint32_t *j = (near).first; j < (near).end; j += LANES)

/* A neighbour per lane: x_ij = x_i - x_j, m; r^2, far above h^2 past the list's end; p_j V_j^2. */
typedef struct Separation {
    f8 x, y, z, r2, term;
} Separation;

/* From neighbours at p, in the layout of args->place. */
SIMD_INLINE Separation apart(Place at, f8x4 p)
{
    Separation d = {.x = at.x - p.x, .y = at.y - p.y, .z = at.z - p.z, .term = p.w};
    d.r2 = d.x * d.x + d.y * d.y + d.z * d.z;
    return d;
}

SIMD_INLINE Separation separation(const PairArgs *args, Place at, const uint32_t *j)
{
    return apart(at, f8_load4(args->place, j));
}

/* v_j, m/s, and V_j. */
SIMD_INLINE f8x4 motion(const PairArgs *args, const uint32_t *j)
{
    return f8_load4(args->motion, j);
}

/* 1 - r / h; 0 past the list's end. */
SIMD_INLINE f8 closeness(f8 q)
{
    return f8_positive(f8_splat(1) - q);
}

#endif
