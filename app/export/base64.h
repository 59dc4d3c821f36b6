/* Bytes as text, which XML can hold. After: RFC 4648, "The Base16, Base32, and Base64 Data Encodings", 2006.
 */
#ifndef SLOSH_BASE64_H
#define SLOSH_BASE64_H

#include <stdio.h>

/* Text that goes into `file`; zero but for that at first. */
typedef struct Base64 {
    FILE *file;
    unsigned char rest[3]; /* bytes that are not written yet */
    size_t count;          /* of them, 0 to 2 */
} Base64;

/* Adds so many bytes. Errors are those of the stream (ferror). */
void base64_add(Base64 *text, const void *bytes, size_t size);

/* The end of the text: the bytes that are left, filled up. */
void base64_end(Base64 *text);

#endif
