/* Eight floats at once, by the vector extension of GCC and clang; inlined into a function for each
   instruction set. Lanes are independent and nothing is contracted, so the bits are the same on any
   machine. */
#ifndef SIM_POINTS_LANES_H
#define SIM_POINTS_LANES_H

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

/* Counter-based random numbers: no state, so threads and lanes need no common order. Philox 4x32 with ten
   rounds. After: J. Salmon, M. Moraes, R. Dror, D. Shaw, "Parallel random numbers: as easy as 1, 2, 3",
   2011. */

typedef uint32_t LaneWords __attribute__((vector_size(4 * LANES)));

/* The use of a stream: fourth word of the counters, so that streams do not overlap. */
typedef enum PhiloxUse { PHILOX_WALK, PHILOX_LINES, PHILOX_SPHERES, PHILOX_TRIANGLES } PhiloxUse;

typedef struct PhiloxKey {
    uint32_t word[2];
} PhiloxKey;

static inline PhiloxKey philox_key(uint64_t seed)
{
    return (PhiloxKey){{(uint32_t)seed, (uint32_t)(seed >> 32)}};
}

/* Replaces a counter by its four random words. */
static inline void philox(PhiloxKey key, uint32_t word[4])
{
    for (int round = 0; round < 10; round++) {
        const uint64_t a = (uint64_t)0xD2511F53 * word[0], b = (uint64_t)0xCD9E8D57 * word[2];
        const uint32_t next[4] = {(uint32_t)(b >> 32) ^ word[1] ^ key.word[0], (uint32_t)b,
                                  (uint32_t)(a >> 32) ^ word[3] ^ key.word[1], (uint32_t)a};
        for (int k = 0; k < 4; k++)
            word[k] = next[k];
        key.word[0] += 0x9E3779B9;
        key.word[1] += 0xBB67AE85;
    }
}

/* The high and the low half of a * b in each lane. */
LANES_INLINE void philox_product(LaneWords a, uint32_t b, LaneWords *high, LaneWords *low)
{
    *low = a * b;
    for (int k = 0; k < LANES; k++)
        (*high)[k] = (uint32_t)((uint64_t)a[k] * b >> 32);
}

/* The same for eight counters. */
LANES_INLINE void philox_lanes(PhiloxKey key, LaneWords word[4])
{
    for (int round = 0; round < 10; round++) {
        LaneWords high[2], low[2];
        philox_product(word[0], 0xD2511F53, &high[0], &low[0]);
        philox_product(word[2], 0xCD9E8D57, &high[1], &low[1]);
        word[0] = high[1] ^ word[1] ^ key.word[0];
        word[1] = low[1];
        word[2] = high[0] ^ word[3] ^ key.word[1];
        word[3] = low[0];
        key.word[0] += 0x9E3779B9;
        key.word[1] += 0xBB67AE85;
    }
}

/* Uniform in 0 .. 1, both ends excluded: the upper 23 bits. */
static inline float philox_uniform(uint32_t word)
{
    return ((float)(word >> 9) + 0.5F) * 0x1p-23F;
}

LANES_INLINE Lanes philox_uniform_lanes(LaneWords word)
{
    return (lanes_number((LaneMask)(word >> 9)) + lanes(0.5F)) * lanes(0x1p-23F);
}

/* Three normal numbers of mean 0 and variance 1 per lane, from four words. After: G. Box, M. Muller, "A
   note on the generation of random normal deviates", 1958. */
LANES_INLINE void philox_normal_lanes(const LaneWords word[4], Lanes normal[3])
{
    Lanes sine, cosine;
    const Lanes r = lanes_sqrt(lanes(-2) * lanes_log(philox_uniform_lanes(word[0])));
    lanes_turn(philox_uniform_lanes(word[1]), &sine, &cosine);
    normal[0] = r * cosine;
    normal[1] = r * sine;
    const Lanes other = lanes_sqrt(lanes(-2) * lanes_log(philox_uniform_lanes(word[2])));
    lanes_turn(philox_uniform_lanes(word[3]), &sine, &cosine);
    normal[2] = other * cosine;
}

#endif
