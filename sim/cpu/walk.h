/* The walk over neighbours: the one that all pair loops have. For the files that are compiled once for each
   instruction set. */
#ifndef SLOSH_WALK_H
#define SLOSH_WALK_H

#include "sim/cpu/simd.h"

/* Where sums stand: in all lanes the same. */
typedef struct Place {
    f8 x, y, z;
} Place;

SIMD_INLINE Place place_at(const float x[3])
{
    return (Place){f8_splat(x[0]), f8_splat(x[1]), f8_splat(x[2])};
}

SIMD_INLINE Place place_of(const PairArgs *args, size_t i)
{
    return (Place){f8_splat(args->x[i]), f8_splat(args->y[i]), f8_splat(args->z[i])};
}

/* The particle's own list. */
typedef struct Near {
    const uint32_t *first, *end;
    bool coincident; /* another one stands where it stands, nearly */
} Near;

SIMD_INLINE Near near_of(const PairArgs *args, size_t i)
{
    const NeighbourLists *lists = args->lists;
    const uint32_t *first = lists->of_range[i / LISTS_GRAIN].index + lists->first[i], count = lists->count[i];
    return (Near){first, first + (count & ~(uint32_t)LISTS_COINCIDENT), (count & LISTS_COINCIDENT) != 0};
}

/* NEIGHBOURS (near, j) { const Separation d = separation(args, at, near, j); ... }: for each eight
   neighbours; j points to their indices. */
#define NEIGHBOURS(near, j) for (const uint32_t *j = (near).first; j < (near).end; j += LANES)

#ifdef PAIRS_PERIODIC
/* The shortest way between two, along an axis that may go through a side. */
SIMD_INLINE f8 shortest(f8 d, float size, float inverse)
{
    return d - f8_splat(size) * f8_round(d * f8_splat(inverse));
}
#endif

/* Eight neighbours: x_ij = x_i - x_j, m; r^2, and of lanes past the list's end far more than h^2; p_j V_j^2.
 */
typedef struct Separation {
    f8 x, y, z, r2, term;
} Separation;

SIMD_INLINE Separation separation(const PairArgs *args, Place at, Near near, const uint32_t *j)
{
    const f8x4 p = f8_load4(args->place, j);
    Separation d = {.x = at.x - p.x, .y = at.y - p.y, .z = at.z - p.z, .term = p.w};
    (void)near;
#ifdef PAIRS_PERIODIC
    const float *size = args->fold, *inverse = args->fold_inverse;
    d.x = shortest(d.x, size[0], inverse[0]);
    d.y = shortest(d.y, size[1], inverse[1]);
    d.z = shortest(d.z, size[2], inverse[2]);
#endif
    d.r2 = d.x * d.x + d.y * d.y + d.z * d.z;
#ifdef PAIRS_PERIODIC
    const i8 there = lane_index < i8_splat((int32_t)(near.end - j));
    d.r2 = f8_select(there, d.r2, f8_splat(PAST));
#endif
    return d;
}

/* v_j, m/s, and V_j, m3. */
SIMD_INLINE f8x4 motion(const PairArgs *args, const uint32_t *j)
{
    return f8_load4(args->motion, j);
}

/* 1 - r / h, and 0 past the list's end. */
SIMD_INLINE f8 closeness(f8 q)
{
    return f8_positive(f8_splat(1) - q);
}

#endif
