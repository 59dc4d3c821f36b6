/* Floats as the passes hand them back: as bits. */
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

/* From bits in the order of the numbers: shaders/common/in_order.glsl. */
static inline float float_in_order(uint32_t ordered)
{
    return float_of_bits(ordered & 0x80000000U ? ordered & 0x7fffffffU : ~ordered);
}

#endif
