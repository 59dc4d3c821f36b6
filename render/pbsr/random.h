/* Random numbers from a counter: a stream gives the same numbers on any thread, at any time. After: G.
   Steele, D. Lea, C. Flood, "Fast splittable pseudorandom number generators", 2014 (SplitMix64). */
#ifndef SLOSH_PBSR_RANDOM_H
#define SLOSH_PBSR_RANDOM_H

#include <math.h>
#include <stdint.h>

typedef struct RandomStream {
    uint64_t counter;
} RandomStream;

static inline uint64_t random_mix(uint64_t z)
{
    z = (z ^ z >> 30) * UINT64_C(0xBF58476D1CE4E5B9);
    z = (z ^ z >> 27) * UINT64_C(0x94D049BB133111EB);
    return z ^ z >> 31;
}

static inline RandomStream random_stream(uint64_t seed, uint64_t set, uint64_t layer)
{
    return (RandomStream){random_mix(seed + UINT64_C(0x632BE59BD9B4E019) * random_mix(set << 8 | layer))};
}

static inline uint64_t random_bits(RandomStream *stream)
{
    return random_mix(stream->counter += UINT64_C(0x9E3779B97F4A7C15));
}

/* 0 <= r < 1 from bits shift .. shift + 20: one word gives three numbers. */
static inline float random_part(uint64_t bits, int shift)
{
    return (float)(bits >> shift & 0x1FFFFF) * 0x1p-21F;
}

/* The gap between events with a mean distance of 1: -log of a number in (0, 1]. */
static inline float random_gap(RandomStream *stream)
{
    return -logf((float)((random_bits(stream) >> 40) + 1) * 0x1p-24F);
}

#endif
