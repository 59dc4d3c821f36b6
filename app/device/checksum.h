/* Checksum in the last four bytes of Bluetooth reports of Sony's controllers: the CRC-32 of a byte for the
   kind of report, then of the report up to the checksum. */
#ifndef SLOSH_CHECKSUM_H
#define SLOSH_CHECKSUM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { CHECKSUM_INPUT = 0xa1, CHECKSUM_FEATURE = 0xa3 }; /* kinds */

uint32_t checksum_of(uint8_t kind, const uint8_t *bytes, size_t size);

/* Returns true if the last four of `size` (at least 4) bytes are the checksum of the bytes before. */
bool checksum_holds(uint8_t kind, const uint8_t *bytes, size_t size);

#endif
