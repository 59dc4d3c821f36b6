#include "sim/cpu/pairs.h"

#include <stdlib.h>
#include <string.h>

extern const PairOps pair_ops_baseline, pair_ops_avx2, pair_ops_baseline_periodic, pair_ops_avx2_periodic;

const PairOps *pair_ops_choose(bool periodic)
{
    const PairOps *baseline = periodic ? &pair_ops_baseline_periodic : &pair_ops_baseline;
    const char *wanted = getenv("SLOSH_SIMD");
    if (wanted && strcmp(wanted, pair_ops_baseline.name) == 0)
        return baseline;
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2"))
        return periodic ? &pair_ops_avx2_periodic : &pair_ops_avx2;
#endif
    return baseline;
}
