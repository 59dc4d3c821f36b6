#include "sim/cpu/pairs.h"

#include <stdlib.h>
#include <string.h>

extern const PairOps pair_ops_baseline, pair_ops_avx2;

const PairOps *pair_ops_choose(void)
{
    const char *wanted = getenv("SLOSH_SIMD");
    if (wanted && strcmp(wanted, pair_ops_baseline.name) == 0)
        return &pair_ops_baseline;
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2"))
        return &pair_ops_avx2;
#endif
    return &pair_ops_baseline;
}
