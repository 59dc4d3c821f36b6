#include "sim/cpu/pair_set.h"

#include <stdlib.h>
#include <string.h>

enum { SIMD_AUTO, SIMD_AVX2, SIMD_BASELINE };

const SimdKind simd_kinds[] = {
    [SIMD_AUTO] = {"auto", "the widest that the processor has"},
    [SIMD_AVX2] = {"avx2", "256 bits"},
    [SIMD_BASELINE] = {"baseline", "what every x86-64 has, 128 bits; elsewhere whatever the compiler finds"},
    {0},
};

static bool has_avx2(void)
{
#if defined(__x86_64__)
    return __builtin_cpu_supports("avx2");
#else
    return false;
#endif
}

static int widest(void)
{
    const char *wanted = getenv("SLOSH_SIMD");
    const bool narrow = wanted && strcmp(wanted, simd_kinds[SIMD_BASELINE].name) == 0;
    return has_avx2() && !narrow ? SIMD_AVX2 : SIMD_BASELINE;
}

bool pair_set_choose(int simd, bool periodic, PairSet *set)
{
    const int kind = simd == SIMD_AUTO ? widest() : simd;
    if (kind == SIMD_AVX2 && !has_avx2())
        return false;
    if (kind == SIMD_AVX2)
        *set = periodic ? PAIR_AVX2_PERIODIC : PAIR_AVX2;
    else
        *set = periodic ? PAIR_BASELINE_PERIODIC : PAIR_BASELINE;
    return true;
}

const char *pair_set_name(PairSet set)
{
    return simd_kinds[set == PAIR_AVX2 || set == PAIR_AVX2_PERIODIC ? SIMD_AVX2 : SIMD_BASELINE].name;
}
