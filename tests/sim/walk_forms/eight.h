/* Sums over eight pairs at a time, for the forms in which these are of one particle. */
#ifndef SLOSH_TEST_EIGHT_H
#define SLOSH_TEST_EIGHT_H

#include "forms.h"
#include "sim/cpu/simd.h"

/* Eight particles, or one eight times. */
typedef struct Eight {
    f8 x, y, z, term, vx, vy, vz, volume;
} Eight;

SIMD_INLINE Eight eight_times(const PairArgs *a, size_t i)
{
    return (Eight){f8_splat(a->x[i]),  f8_splat(a->y[i]),  f8_splat(a->z[i]),  f8_splat(a->pressure_term[i]),
                   f8_splat(a->vx[i]), f8_splat(a->vy[i]), f8_splat(a->vz[i]), f8_splat(a->volume[i])};
}

/* Those that stand one behind the other. */
SIMD_INLINE Eight eight_from(const PairArgs *a, size_t j)
{
    return (Eight){f8_load(a->x + j),  f8_load(a->y + j),  f8_load(a->z + j),  f8_load(a->pressure_term + j),
                   f8_load(a->vx + j), f8_load(a->vy + j), f8_load(a->vz + j), f8_load(a->volume + j)};
}

SIMD_INLINE f8 gathered(const float *column, const uint32_t *j)
{
    return (f8)_mm256_i32gather_ps(column, (__m256i)i8_load((const int32_t *)j), sizeof *column);
}

SIMD_INLINE Eight eight_gathered(const PairArgs *a, const uint32_t *j)
{
    return (Eight){gathered(a->x, j),  gathered(a->y, j),  gathered(a->z, j),  gathered(a->pressure_term, j),
                   gathered(a->vx, j), gathered(a->vy, j), gathered(a->vz, j), gathered(a->volume, j)};
}

SIMD_INLINE Eight eight_packed(const PairArgs *a, const uint32_t *j)
{
    const f8x4 p = f8_load4(a->place, j), v = f8_load4(a->motion, j);
    return (Eight){p.x, p.y, p.z, p.w, v.x, v.y, v.z, v.w};
}

typedef struct Vector8 {
    f8 x, y, z;
} Vector8;

SIMD_INLINE Vector8 between(const Eight *at, const Eight *other)
{
    return (Vector8){at->x - other->x, at->y - other->y, at->z - other->z};
}

SIMD_INLINE f8 square(Vector8 d)
{
    return d.x * d.x + d.y * d.y + d.z * d.z;
}

/* (1 - r/h)^3, and 0 past h. */
SIMD_INLINE f8 near3(f8 r2, f8 inverse_h)
{
    const f8 t = f8_positive(f8_splat(1) - f8_sqrt(r2) * inverse_h);
    return t * t * t;
}

/* What the others do to `at`, 0 past h: as sim/methods/mueller/pairs_mueller.c. */
SIMD_INLINE Vector8 pair_force(const Eight *at, const Eight *other, Vector8 d, f8 r2, f8 inverse_h)
{
    const f8 r = f8_sqrt(r2), t = f8_positive(f8_splat(1) - r * inverse_h);
    const f8 push = t * t * (at->term + other->term) / r, drag = at->volume * t * other->volume;
    return (Vector8){push * d.x + drag * (other->vx - at->vx), push * d.y + drag * (other->vy - at->vy),
                     push * d.z + drag * (other->vz - at->vz)};
}

SIMD_INLINE float f8_sum(f8 a)
{
    return ((a[0] + a[4]) + (a[2] + a[6])) + ((a[1] + a[5]) + (a[3] + a[7]));
}

#endif
