/* Hashes of bytes, and a mix of bits for scatter. */
#ifndef SLOSH_HASH_H
#define SLOSH_HASH_H

#include <stddef.h>
#include <stdint.h>

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
