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

/* The kind named by the environment; -1: unknown name. */
static int wanted_by_environment(void)
{
    const char *wanted = getenv("SLOSH_SIMD");
    int kind = SIMD_AUTO;
    while (wanted && simd_kinds[kind].name && strcmp(wanted, simd_kinds[kind].name) != 0)
        kind++;
    return simd_kinds[kind].name ? kind : -1;
}

bool pair_set_choose(int simd, PairSet *set, Error *error)
{
    int kind = simd == SIMD_AUTO ? wanted_by_environment() : simd;
    if (kind < 0)
        return error_set(error, "SLOSH_SIMD is '%.40s'; auto, avx2 and baseline are there",
                         getenv("SLOSH_SIMD"));
    if (simd == SIMD_AVX2 && !has_avx2())
        return error_set(error, "this processor has no %s; leave solver.simd at auto", simd_kinds[simd].name);
    if (kind == SIMD_AUTO || !has_avx2())
        kind = has_avx2() ? SIMD_AVX2 : SIMD_BASELINE;
    *set = kind == SIMD_AVX2 ? PAIR_AVX2 : PAIR_BASELINE;
    return true;
}

const char *pair_set_name(PairSet set)
{
    return simd_kinds[set == PAIR_AVX2 ? SIMD_AVX2 : SIMD_BASELINE].name;
}
