/* A float from the bits written by passes. */
#ifndef SLOSH_FLOAT_BITS_H
#define SLOSH_FLOAT_BITS_H

#include <stdint.h>
#include <string.h>

static inline float float_of_bits(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

#endif
