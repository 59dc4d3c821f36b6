/* Numbers in HID reports. */
#ifndef SLOSH_LITTLE_ENDIAN_H
#define SLOSH_LITTLE_ENDIAN_H

#include <stdint.h>

static inline int little_i16(const uint8_t *bytes)
{
    return (int16_t)(bytes[0] | bytes[1] << 8);
}

static inline uint32_t little_u16(const uint8_t *bytes)
{
    return bytes[0] | (uint32_t)bytes[1] << 8;
}

static inline uint32_t little_u32(const uint8_t *bytes)
{
    return bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}

#endif
