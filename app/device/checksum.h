/* The checksum in the last four bytes of what Sony's controllers send over Bluetooth: the CRC-32 of a byte
   that tells the kind of report, and of the report before it. */
#ifndef SLOSH_CHECKSUM_H
#define SLOSH_CHECKSUM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { CHECKSUM_INPUT = 0xa1, CHECKSUM_FEATURE = 0xa3 }; /* the kinds */

uint32_t checksum_of(uint8_t kind, const uint8_t *bytes, size_t size);

/* Whether the last four of `size` (at least 4) bytes are that of those before. */
bool checksum_holds(uint8_t kind, const uint8_t *bytes, size_t size);

#endif
