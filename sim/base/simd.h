/* Eight floats at once, on any machine: two registers of 128 bits or a register of 256 bits. Arithmetic uses
   the vector extension of GCC and clang; missing operations are below. Lanes are independent and nothing is
   contracted, so the bits are the same on any machine. A file that includes this is compiled with
   -Wno-psabi: the vectors stay in inlined functions. */
#ifndef SIM_BASE_SIMD_H
#define SIM_BASE_SIMD_H

#include "sim/base/base.h"

#include <stdint.h>

#if defined(__AVX__)
#include <immintrin.h>
#elif defined(__SSE2__)
#include <emmintrin.h>
#else
#include <math.h>
#endif

typedef float f8 __attribute__((vector_size(32)));
typedef int32_t i8 __attribute__((vector_size(32))); /* as a mask: -1 where true */
typedef uint32_t u8 __attribute__((vector_size(32)));
typedef float f8_unaligned __attribute__((vector_size(32), aligned(4), may_alias));
typedef int32_t i8_unaligned __attribute__((vector_size(32), aligned(4), may_alias));

static const i8 lane_index = {0, 1, 2, 3, 4, 5, 6, 7};

#define SIMD_INLINE static inline __attribute__((always_inline))

/* For a function compiled for the wider instruction set, with lanes inlined; call if simd_wide() is true. */
#if defined(__x86_64__)
#define SIMD_WIDE __attribute__((target("avx2")))
#else
#define SIMD_WIDE
#endif

static inline int simd_wide(void)
{
#if defined(__x86_64__)
    return __builtin_cpu_supports("avx2") != 0;
#else
    return 0;
#endif
}

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

SIMD_INLINE f8 f8_abs(f8 a)
{
    return (f8)((i8)a & 0x7fffffff);
}

/* |a| with the sign of b. */
SIMD_INLINE f8 f8_copysign(f8 a, f8 b)
{
    return (f8)(((i8)a & 0x7fffffff) | ((i8)b & INT32_MIN));
}

/* Minimum and maximum; b if a or b is NaN. */
SIMD_INLINE f8 lesser(f8 a, f8 b)
{
#if defined(__AVX__)
    return (f8)_mm256_min_ps((__m256)a, (__m256)b);
#else
    return f8_select(a < b, a, b);
#endif
}

SIMD_INLINE f8 greater(f8 a, f8 b)
{
#if defined(__AVX__)
    return (f8)_mm256_max_ps((__m256)a, (__m256)b);
#else
    return f8_select(a > b, a, b);
#endif
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

/* Entries j[0 .. 7] / 2 of a column. A load can scale twice the index, for columns of 4 and of 16
   bytes. */
SIMD_INLINE f8 f8_gather(const float *p, const uint32_t *j)
{
#define ONE(k) (*(const float *)((const char *)p + 2 * (size_t)j[k]))
    return (f8){ONE(0), ONE(1), ONE(2), ONE(3), ONE(4), ONE(5), ONE(6), ONE(7)};
#undef ONE
}

/* Four columns of eight entries. */
typedef struct f8x4 {
    f8 x, y, z, w;
} f8x4;

/* Entries j[0 .. 7] / 2 of packed columns: loads of 16 bytes and a transposition, at half the cost of four
   gathers. */
SIMD_INLINE f8x4 f8_load4(const float (*p)[4], const uint32_t *j)
{
#define ONE(k) ((const float *)((const char *)p + 8 * (size_t)j[k]))
#if defined(__AVX__)
#define PAIR(k)                                                                                              \
    _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_load_ps(ONE(k))), _mm_load_ps(ONE((k) + 4)), 1)
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
        const __m128 a = _mm_load_ps(ONE(0)), b = _mm_load_ps(ONE(1)), c = _mm_load_ps(ONE(2)),
                     d = _mm_load_ps(ONE(3));
        const __m128 ab = _mm_unpacklo_ps(a, b), cd = _mm_unpacklo_ps(c, d);
        const __m128 AB = _mm_unpackhi_ps(a, b), CD = _mm_unpackhi_ps(c, d);
        x.half[k] = _mm_movelh_ps(ab, cd), y.half[k] = _mm_movehl_ps(cd, ab);
        z.half[k] = _mm_movelh_ps(AB, CD), w.half[k] = _mm_movehl_ps(CD, AB);
    }
    return (f8x4){x.wide, y.wide, z.wide, w.wide};
#else
    const float *const a = ONE(0), *const b = ONE(1), *const c = ONE(2), *const d = ONE(3), *const e = ONE(4),
                       *const f = ONE(5), *const g = ONE(6), *const h = ONE(7);
    return (f8x4){{a[0], b[0], c[0], d[0], e[0], f[0], g[0], h[0]},
                  {a[1], b[1], c[1], d[1], e[1], f[1], g[1], h[1]},
                  {a[2], b[2], c[2], d[2], e[2], f[2], g[2], h[2]},
                  {a[3], b[3], c[3], d[3], e[3], f[3], g[3], h[3]}};
#endif
#undef ONE
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

/* Rounds to the nearest integer, for |a| < 2^22. */
SIMD_INLINE f8 f8_round(f8 a)
{
    const f8 large = f8_splat(0x1.8p23F);
    return (a + large) - large;
}

SIMD_INLINE i8 f8_truncate(f8 a) /* towards 0 */
{
    return __builtin_convertvector(a, i8);
}

SIMD_INLINE f8 f8_from(i8 a)
{
    return __builtin_convertvector(a, f8);
}

/* The natural logarithm of 0 < a < infinity, normal; relative error 1e-7. After: S. Moshier, Cephes, logf. */
SIMD_INLINE f8 f8_log(f8 a)
{
    i8 exponent = (((i8)a >> 23) & 0xff) - 126;
    f8 m = (f8)(((i8)a & 0x007fffff) | 0x3f000000); /* 1/2 .. 1 */
    const i8 low = m < f8_splat(0.70710678F);
    exponent += low;
    m = m + f8_select(low, m, f8_splat(0)) - f8_splat(1);
    f8 p = f8_splat(7.0376836292e-2F);
    p = p * m + f8_splat(-1.1514610310e-1F);
    p = p * m + f8_splat(1.1676998740e-1F);
    p = p * m + f8_splat(-1.2420140846e-1F);
    p = p * m + f8_splat(1.4249322787e-1F);
    p = p * m + f8_splat(-1.6668057665e-1F);
    p = p * m + f8_splat(2.0000714765e-1F);
    p = p * m + f8_splat(-2.4999993993e-1F);
    p = p * m + f8_splat(3.3333331174e-1F);
    const f8 square = m * m;
    return m + (p * m * square - f8_splat(0.5F) * square) + f8_from(exponent) * f8_splat(0.69314718F);
}

/* Sine and cosine of an angle in turns, |turns| < 2^20; error 1e-7. After: S. Moshier, Cephes, sinf and
   cosf. */
SIMD_INLINE void f8_sincos(f8 turns, f8 *sine, f8 *cosine)
{
    const f8 quarters = f8_round(f8_splat(4) * turns);
    const i8 quadrant = f8_truncate(quarters);
    const f8 x = (turns - f8_splat(0.25F) * quarters) * f8_splat(6.28318531F),
             square = x * x; /* |x| <= pi / 4 */
    f8 s = f8_splat(-1.9515295891e-4F);
    s = s * square + f8_splat(8.3321608736e-3F);
    s = s * square + f8_splat(-1.6666654611e-1F);
    s = s * square * x + x;
    f8 c = f8_splat(2.443315711809948e-5F);
    c = c * square + f8_splat(-1.388731625493765e-3F);
    c = c * square + f8_splat(4.166664568298827e-2F);
    c = c * square * square - f8_splat(0.5F) * square + f8_splat(1);
    const i8 odd = -(quadrant & 1);
    const f8 a = f8_select(odd, c, s), b = f8_select(odd, s, c);
    *sine = (f8)((i8)a ^ ((quadrant & 2) << 30));
    *cosine = (f8)((i8)b ^ (((quadrant + 1) & 2) << 30));
}

#endif
