/* Instruction sets of the pair loops in files NAME/pairs*.c. The best set for the processor is chosen when
   a world is made. All sets give the same bits. */
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

/* PAIR_LOOPS(name): declares the loop defined by PAIR_LOOP(name) in a file NAME/pairs*.c. */
#if defined(__x86_64__)
#define PAIR_LOOPS(name)                                                                                     \
    PairLoop name##_baseline, name##_avx2;                                                                   \
    static const PairLoops name = {{name##_baseline, name##_avx2}}
#else
#define PAIR_LOOPS(name)                                                                                     \
    PairLoop name##_baseline;                                                                                \
    static const PairLoops name = {{name##_baseline}}
#endif

/* Values of solver.simd, ended by a NULL name; the first value takes the widest set of the processor. */
typedef struct SimdKind {
    const char *name, *help;
} SimdKind;

extern const SimdKind simd_kinds[];

/* Chooses the set for entry `simd` of simd_kinds. Entry 0 takes the set named by the environment variable
   SLOSH_SIMD if the processor has the set (for tests of the whole program), otherwise the widest set.
   Returns false, with the reason, if the choice is impossible. */
bool pair_set_choose(int simd, PairSet *set, Error *error);

/* The set's name in simd_kinds. */
const char *pair_set_name(PairSet set);

#endif
