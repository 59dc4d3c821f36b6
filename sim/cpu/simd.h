/* One wide type: eight floats, whatever the machine has. Sums therefore run in eight lanes and in one order
   on every x86-64, with 128-bit registers or with 256-bit ones, to the same bits.

   Arithmetic is GCC's and clang's vector extension; what it lacks is below. */
#ifndef SLOSH_SIMD_H
#define SLOSH_SIMD_H

#include "sim/cpu/pair_args.h"

#include <stdint.h>

#if defined(__SSE2__)
#include <immintrin.h>
#else
#include <math.h>
#endif

typedef float f8 __attribute__((vector_size(32)));
typedef int32_t i8 __attribute__((vector_size(32)));
typedef float f8_unaligned __attribute__((vector_size(32), aligned(4), may_alias));

#define SIMD_INLINE static inline __attribute__((always_inline))

SIMD_INLINE f8 f8_load(const float *p)
{
    return *(const f8_unaligned *)p;
}

SIMD_INLINE f8 f8_splat(float x)
{
    return (f8){x, x, x, x, x, x, x, x};
}

SIMD_INLINE i8 i8_splat(int32_t x)
{
    return (i8){x, x, x, x, x, x, x, x};
}

/* Lanes of a where the mask is set, of b elsewhere. */
SIMD_INLINE f8 f8_select(i8 mask, f8 a, f8 b)
{
    return (f8)(((i8)a & mask) | ((i8)b & ~mask));
}

SIMD_INLINE f8 f8_masked(i8 mask, f8 a)
{
    return (f8)((i8)a & mask);
}

SIMD_INLINE f8 f8_sqrt(f8 a)
{
#if defined(__AVX__)
    return (f8)_mm256_sqrt_ps((__m256)a);
#elif defined(__SSE2__)
    union {
        f8 wide;
        __m128 half[2];
    } u = {a};
    u.half[0] = _mm_sqrt_ps(u.half[0]);
    u.half[1] = _mm_sqrt_ps(u.half[1]);
    return u.wide;
#else
    for (int k = 0; k < LANES; k++)
        a[k] = sqrtf(a[k]);
    return a;
#endif
}

/* One bit a lane. */
SIMD_INLINE int i8_bits(i8 mask)
{
#if defined(__AVX__)
    return _mm256_movemask_ps((__m256)mask);
#elif defined(__SSE2__)
    union {
        i8 wide;
        __m128 half[2];
    } u = {mask};
    return _mm_movemask_ps(u.half[0]) | _mm_movemask_ps(u.half[1]) << 4;
#else
    int bits = 0;
    for (int k = 0; k < LANES; k++)
        bits |= (mask[k] != 0) << k;
    return bits;
#endif
}

/* The sum of the lanes, always in this order. */
SIMD_INLINE float f8_sum(f8 a)
{
    return ((a[0] + a[4]) + (a[2] + a[6])) + ((a[1] + a[5]) + (a[3] + a[7]));
}

#endif
