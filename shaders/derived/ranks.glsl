// Four ranks of a scalar's values: the least, the 1st and the 99th percentile, the greatest. By a radix selection: the bits of a
// number in the order of numbers, in digits of 11, 11 and 10 bits from the highest. For each digit the values that agree with a
// rank in all higher ones are counted by that digit (ranks_count.comp), then the rank's digit is found (ranks_find.comp). Counts are whole
// numbers: the result is exact, and the same whatever the order.
#include "shaders/derived/derived_bindings.h"
layout(std430, binding = RANKS_FOUND_STORAGE) buffer Found {
    uint known;    // numbers there are
    uint found[4]; // the higher digits of each rank, ascending
    uint left[4];  // its place among those that agree with them
};
layout(std430, binding = RANK_BINS_STORAGE) buffer Bins { uint bins[]; }; // 2048 for each rank; equal ones count for the first
layout(location = DIGIT_AT) uniform uint digit;                           // 0, 1, 2

const uint digit_bins = 2048u;

uint digit_shift()
{
    return digit == 0u ? 21u : digit == 1u ? 10u : 0u;
}
