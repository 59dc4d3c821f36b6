#include "app/export/base64.h"

static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/* Encodes three bytes as four digits. */
static void encode(const unsigned char from[3], char to[4])
{
    const unsigned bits = (unsigned)from[0] << 16 | (unsigned)from[1] << 8 | from[2];
    for (int k = 0; k < 4; k++)
        to[k] = digits[bits >> (18 - 6 * k) & 63];
}

void base64_add(Base64 *text, const void *bytes, size_t size)
{
    const unsigned char *from = bytes;
    char out[4096];
    size_t used = 0;
    for (size_t i = 0; i < size; i++) {
        text->rest[text->count++] = from[i];
        if (text->count < 3)
            continue;
        encode(text->rest, out + used);
        text->count = 0;
        used += 4;
        if (used == sizeof out) {
            fwrite(out, 1, used, text->file);
            used = 0;
        }
    }
    fwrite(out, 1, used, text->file);
}

void base64_end(Base64 *text)
{
    char out[4];
    if (text->count == 0)
        return;
    for (size_t k = text->count; k < 3; k++)
        text->rest[k] = 0;
    encode(text->rest, out);
    for (size_t k = text->count + 1; k < 4; k++)
        out[k] = '=';
    fwrite(out, 1, sizeof out, text->file);
    text->count = 0;
}
