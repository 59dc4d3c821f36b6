/* Counter-based random numbers: no state, so threads and lanes need no common order. Philox 4x32 with ten
   rounds. After: J. Salmon, M. Moraes, R. Dror, D. Shaw, "Parallel random numbers: as easy as 1, 2, 3",
   2011. */
#ifndef SIM_POINTS_PHILOX_H
#define SIM_POINTS_PHILOX_H

#include "sim/base/simd.h"

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
SIMD_INLINE void philox_product(u8 a, uint32_t b, u8 *high, u8 *low)
{
    *low = a * b;
    for (int k = 0; k < LANES; k++)
        (*high)[k] = (uint32_t)((uint64_t)a[k] * b >> 32);
}

/* The same for eight counters. */
SIMD_INLINE void philox_lanes(PhiloxKey key, u8 word[4])
{
    for (int round = 0; round < 10; round++) {
        u8 high[2], low[2];
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

SIMD_INLINE f8 philox_uniform_lanes(u8 word)
{
    return (f8_from((i8)(word >> 9)) + f8_splat(0.5F)) * f8_splat(0x1p-23F);
}

/* Three normal numbers of mean 0 and variance 1 per lane, from four words. After: G. Box, M. Muller, "A
   note on the generation of random normal deviates", 1958. */
SIMD_INLINE void philox_normal_lanes(const u8 word[4], f8 normal[3])
{
    f8 sine, cosine;
    const f8 r = f8_sqrt(f8_splat(-2) * f8_log(philox_uniform_lanes(word[0])));
    f8_sincos(philox_uniform_lanes(word[1]), &sine, &cosine);
    normal[0] = r * cosine;
    normal[1] = r * sine;
    const f8 other = f8_sqrt(f8_splat(-2) * f8_log(philox_uniform_lanes(word[2])));
    f8_sincos(philox_uniform_lanes(word[3]), &sine, &cosine);
    normal[2] = other * cosine;
}

#endif
