// Four ranks of a scalar's values: the least, the 1st and the 99th percentile, the greatest. By radix selection on bits ordered
// like the numbers, in digits of 11, 11 and 10 bits from the highest. For each digit, ranks_count.comp counts the values that
// agree with a rank in all higher digits; ranks_find.comp then finds the rank's digit. Counts are integers: the result is exact
// and independent of the order.
#include "shaders/derived/derived_bindings.h"
layout(std430, binding = RANKS_FOUND_STORAGE) buffer Found {
    uint known;    // number of finite values
    uint found[4]; // the higher digits of each rank, ascending
    uint left[4];  // the rank among the values with the same higher digits
};
layout(std430, binding = RANK_BINS_STORAGE) buffer Bins { uint bins[]; }; // 2048 per rank; equal ranks share the bins of the first
layout(location = DIGIT_AT) uniform uint digit;                           // 0, 1, 2

const uint digit_bins = 2048u;

uint digit_shift()
{
    return digit == 0u ? 21u : digit == 1u ? 10u : 0u;
}
