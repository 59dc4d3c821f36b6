/* Exact sums, independent of the order of terms; rounded only when read. Parts of a sum, from threads or
   ranks, add up to the same bits for any division of the work. After: R. Neal, "Fast exact summation using
   small and large superaccumulators", 2015. */
#ifndef SIM_BASE_SUMS_H
#define SIM_BASE_SUMS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* Bin k counts multiples of 2^(32 k - EXACT_BELOW): each bin holds at least 2^42 numbers. */
enum { EXACT_BINS = 16, EXACT_BELOW = 400, EXACT_WORDS = 3 * EXACT_BINS + 1 };

/* Zero-initialise. */
typedef struct ExactSum {
    __int128 bin[EXACT_BINS];
    bool strange; /* a term was not finite, or 2^164 or more */
} ExactSum;

/* Adds a number, without its part below 2^-400. */
static inline void exact_add(ExactSum *sum, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    const int place = (int)(bits >> 52 & 0x7ff) - (1075 - EXACT_BELOW);
    if (place < 0)
        return;
    if (place >= 32 * EXACT_BINS) {
        sum->strange = true;
        return;
    }
    const __int128 whole = (__int128)((bits & 0xfffffffffffff) | 0x10000000000000) << (place & 31);
    sum->bin[place >> 5] += bits >> 63 ? -whole : whole;
}

/* Adds a second sum. */
void exact_merge(ExactSum *sum, const ExactSum *part);

/* The rounded sum; NaN if a term was strange. */
double exact_value(const ExactSum *sum);

/* The sum as integers that can be added word by word, for at most 2^31 sums. */
void exact_to_words(const ExactSum *sum, int64_t words[EXACT_WORDS]);
void exact_from_words(const int64_t words[EXACT_WORDS], ExactSum *sum);

/* Hashes of bytes, and a mix of bits for scatter. */

/* FNV-1a, 64 bits: http://www.isthe.com/chongo/tech/comp/fnv. Hash of no bytes. */
#define HASH_NONE 0xcbf29ce484222325ULL

/* Extends `hash` by further bytes. */
static inline uint64_t hash_add(uint64_t hash, const void *bytes, size_t size)
{
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ ((const uint8_t *)bytes)[i]) * 0x100000001b3ULL;
    return hash;
}

/* Mixes 32 bits, one to one: C. Wellons, "Prospecting for hash functions", 2018, "lowbias32". */
static inline uint32_t hash_mix(uint32_t bits)
{
    bits = (bits ^ bits >> 16) * 0x7feb352dU;
    bits = (bits ^ bits >> 15) * 0x846ca68bU;
    return bits ^ bits >> 16;
}

#endif
