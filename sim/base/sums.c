#include "sim/base/base.h"

#include <math.h>

void exact_merge(ExactSum *sum, const ExactSum *part)
{
    for (int k = 0; k < EXACT_BINS; k++)
        sum->bin[k] += part->bin[k];
    sum->strange |= part->strange;
}

double exact_value(const ExactSum *sum)
{
    double value = 0;
    for (int k = EXACT_BINS - 1; k >= 0; k--)
        value += ldexp((double)sum->bin[k], 32 * k - EXACT_BELOW);
    return sum->strange ? NAN : value;
}

void exact_to_words(const ExactSum *sum, int64_t words[EXACT_WORDS])
{
    for (int k = 0; k < EXACT_BINS; k++) {
        const __int128 bin = sum->bin[k];
        words[3 * k] = (int64_t)(bin & 0xffffffff);
        words[3 * k + 1] = (int64_t)((bin >> 32) & 0xffffffff);
        words[3 * k + 2] = (int64_t)(bin >> 64);
    }
    words[3 * EXACT_BINS] = sum->strange;
}

void exact_from_words(const int64_t words[EXACT_WORDS], ExactSum *sum)
{
    for (int k = 0; k < EXACT_BINS; k++)
        sum->bin[k] = words[3 * k] + (__int128)words[3 * k + 1] * ((__int128)1 << 32) +
                      (__int128)words[3 * k + 2] * ((__int128)1 << 64);
    sum->strange = words[3 * EXACT_BINS] != 0;
}
