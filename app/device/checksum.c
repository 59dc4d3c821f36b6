#include "app/device/checksum.h"

#include "app/device/little_endian.h"

#include <zlib.h>

uint32_t checksum_of(uint8_t kind, const uint8_t *bytes, size_t size)
{
    return (uint32_t)crc32(crc32(0, &kind, 1), bytes, (uInt)size);
}

bool checksum_holds(uint8_t kind, const uint8_t *bytes, size_t size)
{
    return size >= 4 && little_u32(bytes + size - 4) == checksum_of(kind, bytes, size - 4);
}
