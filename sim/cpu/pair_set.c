#include "sim/cpu/pair_set.h"

#include <stdlib.h>
#include <string.h>

PairSet pair_set_choose(bool periodic)
{
    const PairSet baseline = periodic ? PAIR_BASELINE_PERIODIC : PAIR_BASELINE;
    const char *wanted = getenv("SLOSH_SIMD");
    if (wanted && strcmp(wanted, "baseline") == 0)
        return baseline;
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2"))
        return periodic ? PAIR_AVX2_PERIODIC : PAIR_AVX2;
#endif
    return baseline;
}
