/* FNV-1a, 64 bits: http://www.isthe.com/chongo/tech/comp/fnv. */
#ifndef SLOSH_HASH_H
#define SLOSH_HASH_H

#include <stddef.h>
#include <stdint.h>

/* Hash of no bytes. */
#define HASH_NONE 0xcbf29ce484222325ULL

/* Extends `hash` by further bytes. */
static inline uint64_t hash_add(uint64_t hash, const void *bytes, size_t size)
{
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ ((const uint8_t *)bytes)[i]) * 0x100000001b3ULL;
    return hash;
}

#endif
