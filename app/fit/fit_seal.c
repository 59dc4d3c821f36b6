#include "app/fit/fit_seal.h"

#include "app/lab/run_key.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char SUM[] = "# slosh fit may replace this file as long as its sum is ";
enum { DIGITS = 16 };

static void sum_of(const char *head, const char *body, char digits[DIGITS + 1])
{
    snprintf(digits, DIGITS + 1, "%016" PRIx64, run_key_text(run_key_text(RUN_KEY, head), body));
}

char *fit_seal(const char *head, const char *body)
{
    char digits[DIGITS + 1];
    const size_t size = strlen(head) + strlen(SUM) + DIGITS + 1 + strlen(body) + 1;
    char *text = malloc(size);
    sum_of(head, body, digits);
    if (text)
        snprintf(text, size, "%s%s%s\n%s", head, SUM, digits, body);
    return text;
}

bool fit_is_sealed(char *text, size_t size)
{
    char digits[DIGITS + 1];
    char *sum = strlen(text) == size ? strstr(text, SUM) : NULL;
    if (!sum)
        return false;
    const char *has = sum + strlen(SUM);
    if (strspn(has, "0123456789abcdef") != DIGITS || has[DIGITS] != '\n')
        return false;
    *sum = '\0';
    sum_of(text, has + DIGITS + 1, digits);
    return strncmp(has, digits, DIGITS) == 0;
}
