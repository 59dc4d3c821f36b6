/* The instruction sets that the loops over pairs are compiled for, in files NAME/pairs*.c: the one that fits
   the processor is chosen when a world is made. All of them give the same bits. */
#ifndef SLOSH_PAIR_SET_H
#define SLOSH_PAIR_SET_H

#include "sim/base/error.h"
#include "sim/cpu/pair_args.h"

typedef enum PairSet { PAIR_BASELINE, PAIR_AVX2, PAIR_SETS } PairSet;

/* Sums for the particles [begin, end). */
typedef void PairLoop(const PairArgs *args, size_t begin, size_t end);

/* A loop in all sets. */
typedef struct PairLoops {
    PairLoop *in[PAIR_SETS];
} PairLoops;

/* PAIR_LOOPS(name): the loop that a file NAME/pairs*.c begins with PAIR_LOOP(name). */
#if defined(__x86_64__)
#define PAIR_LOOPS(name)                                                                                     \
    PairLoop name##_baseline, name##_avx2;                                                                   \
    static const PairLoops name = {{name##_baseline, name##_avx2}}
#else
#define PAIR_LOOPS(name)                                                                                     \
    PairLoop name##_baseline;                                                                                \
    static const PairLoops name = {{name##_baseline}}
#endif

/* What solver.simd may say, ended by a NULL name: the widest that the processor has first. */
typedef struct SimdKind {
    const char *name, *help;
} SimdKind;

extern const SimdKind simd_kinds[];

/* The set of that number in simd_kinds; of the first what the environment variable SLOSH_SIMD
   names, as far as the processor has it, for tests of a whole program; else the widest that the processor
   has. False, with the reason, where it cannot. */
bool pair_set_choose(int simd, PairSet *set, Error *error);

/* Its name in simd_kinds. */
const char *pair_set_name(PairSet set);

#endif
