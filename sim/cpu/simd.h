/* A wide type of eight floats on any machine: two registers of 128 bits or a register of 256 bits.
   Arithmetic uses the vector extension of GCC and clang; missing operations are below. */
#ifndef SLOSH_SIMD_H
#define SLOSH_SIMD_H

#include "sim/cpu/pairs.h"

#include <stdint.h>

#if defined(__SSE2__)
#include <immintrin.h>
#else
#include <math.h>
#endif

typedef float f8 __attribute__((vector_size(32)));
typedef int32_t i8 __attribute__((vector_size(32)));
typedef float f8_unaligned __attribute__((vector_size(32), aligned(4), may_alias));
typedef int32_t i8_unaligned __attribute__((vector_size(32), aligned(4), may_alias));

static const i8 lane_index = {0, 1, 2, 3, 4, 5, 6, 7};

#define SIMD_INLINE static inline __attribute__((always_inline))

SIMD_INLINE f8 f8_load(const float *p)
{
    return *(const f8_unaligned *)p;
}

SIMD_INLINE i8 i8_load(const int32_t *p)
{
    return *(const i8_unaligned *)p;
}

SIMD_INLINE void f8_store(float *p, f8 a)
{
    *(f8_unaligned *)p = a;
}

SIMD_INLINE void i8_store(int32_t *p, i8 a)
{
    *(i8_unaligned *)p = a;
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

SIMD_INLINE f8 lesser(f8 a, f8 b)
{
    return f8_select(a < b, a, b);
}

SIMD_INLINE f8 greater(f8 a, f8 b)
{
    return f8_select(a > b, a, b);
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

/* max(a, 0). */
SIMD_INLINE f8 f8_positive(f8 a)
{
#if defined(__AVX__)
    return (f8)_mm256_max_ps((__m256)a, _mm256_setzero_ps());
#else
    return f8_masked(a > f8_splat(0), a);
#endif
}

SIMD_INLINE f8 f8_gather(const float *p, const uint32_t *j)
{
    return (f8){p[j[0]], p[j[1]], p[j[2]], p[j[3]], p[j[4]], p[j[5]], p[j[6]], p[j[7]]};
}

/* Four columns of eight entries. */
typedef struct f8x4 {
    f8 x, y, z, w;
} f8x4;

/* Entries j[0 .. 7] of packed columns: loads of 16 bytes and a transposition, at half the cost of four
   gathers. */
SIMD_INLINE f8x4 f8_load4(const float (*p)[4], const uint32_t *j)
{
#if defined(__AVX__)
#define PAIR(k)                                                                                              \
    _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_load_ps(p[j[k]])), _mm_load_ps(p[j[(k) + 4]]), 1)
    const __m256 a = PAIR(0), b = PAIR(1), c = PAIR(2), d = PAIR(3);
#undef PAIR
    const __m256 ab = _mm256_unpacklo_ps(a, b), cd = _mm256_unpacklo_ps(c, d);
    const __m256 AB = _mm256_unpackhi_ps(a, b), CD = _mm256_unpackhi_ps(c, d);
    return (f8x4){(f8)_mm256_shuffle_ps(ab, cd, 0x44), (f8)_mm256_shuffle_ps(ab, cd, 0xee),
                  (f8)_mm256_shuffle_ps(AB, CD, 0x44), (f8)_mm256_shuffle_ps(AB, CD, 0xee)};
#elif defined(__SSE2__)
    union {
        f8 wide;
        __m128 half[2];
    } x, y, z, w;
    for (int k = 0; k < 2; k++, j += 4) {
        const __m128 a = _mm_load_ps(p[j[0]]), b = _mm_load_ps(p[j[1]]), c = _mm_load_ps(p[j[2]]),
                     d = _mm_load_ps(p[j[3]]);
        const __m128 ab = _mm_unpacklo_ps(a, b), cd = _mm_unpacklo_ps(c, d);
        const __m128 AB = _mm_unpackhi_ps(a, b), CD = _mm_unpackhi_ps(c, d);
        x.half[k] = _mm_movelh_ps(ab, cd), y.half[k] = _mm_movehl_ps(cd, ab);
        z.half[k] = _mm_movelh_ps(AB, CD), w.half[k] = _mm_movehl_ps(CD, AB);
    }
    return (f8x4){x.wide, y.wide, z.wide, w.wide};
#else
    const float *const a = p[j[0]], *const b = p[j[1]], *const c = p[j[2]], *const d = p[j[3]],
                       *const e = p[j[4]], *const f = p[j[5]], *const g = p[j[6]], *const h = p[j[7]];
    return (f8x4){{a[0], b[0], c[0], d[0], e[0], f[0], g[0], h[0]},
                  {a[1], b[1], c[1], d[1], e[1], f[1], g[1], h[1]},
                  {a[2], b[2], c[2], d[2], e[2], f[2], g[2], h[2]},
                  {a[3], b[3], c[3], d[3], e[3], f[3], g[3], h[3]}};
#endif
}

/* A bit per lane. */
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

SIMD_INLINE int i8_sum(i8 a)
{
    return ((a[0] + a[4]) + (a[2] + a[6])) + ((a[1] + a[5]) + (a[3] + a[7]));
}

#endif
