/* Eight floats at once, by the vector extension of GCC and clang; inlined into a function for each
   instruction set. Lanes are independent and nothing is contracted, so the bits are the same on any
   machine. */
#ifndef SLOSH_SURFACE_LANES_H
#define SLOSH_SURFACE_LANES_H

#include <stdint.h>

#if defined(__SSE2__)
#include <emmintrin.h>
#else
#include <math.h>
#endif

enum { LANES = 8 };

typedef float Lanes __attribute__((vector_size(4 * LANES)));
typedef int32_t LaneMask __attribute__((vector_size(4 * LANES))); /* -1 where true */

#define LANES_INLINE static inline __attribute__((always_inline))

/* For a function compiled for the wider instruction set, with lanes inlined; call if lanes_wide() is true. */
#if defined(__x86_64__)
#define LANES_WIDE __attribute__((target("avx2")))
#else
#define LANES_WIDE
#endif

static inline int lanes_wide(void)
{
#if defined(__x86_64__)
    return __builtin_cpu_supports("avx2") != 0;
#else
    return 0;
#endif
}

LANES_INLINE Lanes lanes(float a)
{
    return (Lanes){a, a, a, a, a, a, a, a};
}

/* a where the mask is set, b elsewhere. */
LANES_INLINE Lanes lanes_select(LaneMask mask, Lanes a, Lanes b)
{
    return (Lanes)(((LaneMask)a & mask) | ((LaneMask)b & ~mask));
}

LANES_INLINE Lanes lanes_abs(Lanes a)
{
    return (Lanes)((LaneMask)a & 0x7fffffff);
}

/* |a| with the sign of b. */
LANES_INLINE Lanes lanes_signed(Lanes a, Lanes b)
{
    return (Lanes)(((LaneMask)a & 0x7fffffff) | ((LaneMask)b & INT32_MIN));
}

/* Minimum and maximum; b if a or b is NaN. */
LANES_INLINE Lanes lanes_least(Lanes a, Lanes b)
{
    return lanes_select(a < b, a, b);
}

LANES_INLINE Lanes lanes_most(Lanes a, Lanes b)
{
    return lanes_select(a > b, a, b);
}

/* Rounds to the nearest integer, for |a| < 2^22. */
LANES_INLINE Lanes lanes_round(Lanes a)
{
    const Lanes large = lanes(0x1.8p23F);
    return (a + large) - large;
}

LANES_INLINE LaneMask lanes_whole(Lanes a) /* towards 0 */
{
    return __builtin_convertvector(a, LaneMask);
}

LANES_INLINE Lanes lanes_number(LaneMask a)
{
    return __builtin_convertvector(a, Lanes);
}

LANES_INLINE int lanes_bits(LaneMask mask) /* a bit per lane */
{
#if defined(__SSE2__)
    union {
        LaneMask all;
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

LANES_INLINE Lanes lanes_sqrt(Lanes a)
{
#if defined(__SSE2__)
    union {
        Lanes all;
        __m128 half[2];
    } u = {a};
    u.half[0] = _mm_sqrt_ps(u.half[0]);
    u.half[1] = _mm_sqrt_ps(u.half[1]);
    return u.all;
#else
    for (int k = 0; k < LANES; k++)
        a[k] = sqrtf(a[k]);
    return a;
#endif
}

/* The natural logarithm of 0 < a < infinity, normal; relative error 1e-7. After: S. Moshier, Cephes, logf. */
LANES_INLINE Lanes lanes_log(Lanes a)
{
    LaneMask exponent = (((LaneMask)a >> 23) & 0xff) - 126;
    Lanes m = (Lanes)(((LaneMask)a & 0x007fffff) | 0x3f000000); /* 1/2 .. 1 */
    const LaneMask low = m < lanes(0.70710678F);
    exponent += low;
    m = m + lanes_select(low, m, lanes(0)) - lanes(1);
    Lanes p = lanes(7.0376836292e-2F);
    p = p * m + lanes(-1.1514610310e-1F);
    p = p * m + lanes(1.1676998740e-1F);
    p = p * m + lanes(-1.2420140846e-1F);
    p = p * m + lanes(1.4249322787e-1F);
    p = p * m + lanes(-1.6668057665e-1F);
    p = p * m + lanes(2.0000714765e-1F);
    p = p * m + lanes(-2.4999993993e-1F);
    p = p * m + lanes(3.3333331174e-1F);
    const Lanes square = m * m;
    return m + (p * m * square - lanes(0.5F) * square) + lanes_number(exponent) * lanes(0.69314718F);
}

/* Sine and cosine of an angle in turns, |turns| < 2^20; error 1e-7. After: S. Moshier, Cephes, sinf and
   cosf. */
LANES_INLINE void lanes_turn(Lanes turns, Lanes *sine, Lanes *cosine)
{
    const Lanes quarters = lanes_round(lanes(4) * turns);
    const LaneMask quadrant = lanes_whole(quarters);
    const Lanes x = (turns - lanes(0.25F) * quarters) * lanes(6.28318531F),
                square = x * x; /* |x| <= pi / 4 */
    Lanes s = lanes(-1.9515295891e-4F);
    s = s * square + lanes(8.3321608736e-3F);
    s = s * square + lanes(-1.6666654611e-1F);
    s = s * square * x + x;
    Lanes c = lanes(2.443315711809948e-5F);
    c = c * square + lanes(-1.388731625493765e-3F);
    c = c * square + lanes(4.166664568298827e-2F);
    c = c * square * square - lanes(0.5F) * square + lanes(1);
    const LaneMask odd = -(quadrant & 1);
    const Lanes a = lanes_select(odd, c, s), b = lanes_select(odd, s, c);
    *sine = (Lanes)((LaneMask)a ^ ((quadrant & 2) << 30));
    *cosine = (Lanes)((LaneMask)b ^ (((quadrant + 1) & 2) << 30));
}

#endif
