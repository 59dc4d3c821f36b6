/* Base64: bytes as text, allowed in XML. After: RFC 4648, "The Base16, Base32, and Base64 Data Encodings",
   2006. */
#ifndef SLOSH_BASE64_H
#define SLOSH_BASE64_H

#include <stdio.h>

/* State of an encoder writing to `file`; zero-initialise all but `file`. */
typedef struct Base64 {
    FILE *file;
    unsigned char rest[3]; /* bytes not written yet */
    size_t count;          /* count of these, 0 to 2 */
} Base64;

/* Adds `size` bytes. Errors are those of the stream (ferror). */
void base64_add(Base64 *text, const void *bytes, size_t size);

/* Ends the text: pads and writes the remaining bytes. */
void base64_end(Base64 *text);

#endif
