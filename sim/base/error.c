#include "sim/base/error.h"

#include <stdarg.h>
#include <stdio.h>

void text_tame(char *text)
{
    for (unsigned char *c = (unsigned char *)text; *c; c++) {
        const bool upper = *c == 0xc2 && c[1] >= 0x80 && c[1] < 0xa0; /* U+0080 to U+009F in UTF-8 */
        if ((*c < ' ' && *c != '\n' && *c != '\t') || *c == 0x7f || upper)
            *c = '?';
        if (upper)
            *++c = '?';
    }
}

bool error_set(Error *error, const char *format, ...)
{
    if (error) {
        va_list args;
        va_start(args, format);
        vsnprintf(error->message, sizeof error->message, format, args);
        va_end(args);
        text_tame(error->message);
    }
    return false;
}

int number_digits(size_t count, int least)
{
    int digits = 1;
    for (size_t left = count > 0 ? (count - 1) / 10 : 0; left > 0; left /= 10)
        digits++;
    return digits > least ? digits : least;
}

void number_grouped(size_t number, char text[32])
{
    char digits[24];
    const int count = snprintf(digits, sizeof digits, "%zu", number);
    for (int i = 0; i < count; i++) {
        *text++ = digits[i];
        if (i + 1 < count && (count - i - 1) % 3 == 0)
            *text++ = ',';
    }
    *text = 0;
}
