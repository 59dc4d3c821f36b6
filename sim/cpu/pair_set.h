/* The instruction sets that the loops over pairs are compiled for, in files NAME/pairs*.c: the one that fits
   the processor is chosen when a world is made. All of them give the same bits. */
#ifndef SLOSH_PAIR_SET_H
#define SLOSH_PAIR_SET_H

#include "sim/cpu/pair_args.h"

/* Those of a box with periodic sides have loops of their own. */
typedef enum PairSet { PAIR_BASELINE, PAIR_AVX2, PAIR_BASELINE_PERIODIC, PAIR_AVX2_PERIODIC } PairSet;

/* Sums for the particles [begin, end). */
typedef void PairLoop(const PairArgs *args, size_t begin, size_t end);

/* A loop in all sets. */
typedef struct PairLoops {
    PairLoop *in[4];
} PairLoops;

/* PAIR_LOOPS(name): the loop that a file NAME/pairs*.c begins with PAIR_LOOP(name). */
#define PAIR_LOOPS(name)                                                                                     \
    PairLoop name##_baseline, name##_avx2, name##_baseline_periodic, name##_avx2_periodic;                   \
    static const PairLoops name = {                                                                          \
        {name##_baseline, name##_avx2, name##_baseline_periodic, name##_avx2_periodic}}

/* The widest that this processor has, or the one that the environment variable SLOSH_SIMD names, if it can.
 */
PairSet pair_set_choose(bool periodic);

#endif
