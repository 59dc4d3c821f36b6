/* Forces on box and solids, as sums with the same bits for any division of the work: per cell in double,
   exact over cells. */
#ifndef SLOSH_CPU_FELT_H
#define SLOSH_CPU_FELT_H

#include "sim/cpu/cpu.h"

enum { PUSH_NUMBERS = sizeof(Push) / sizeof(double), FELT_MOST = SOLIDS_MAX + 1 };

typedef struct PushSum {
    ExactSum number[PUSH_NUMBERS];
} PushSum;

/* The part of a range. Initialize `any` to false; the rest needs no value. */
typedef struct CpuFelt {
    bool any;
    PushSum of[FELT_MOST]; /* the box, then each solid */
} CpuFelt;

/* Adds a push to the box (`whom` 0) or to solid k (`whom` 1 + k). */
void cpu_felt_add(CpuFelt *felt, int whom, const Push *push);

/* cpu_felt_begin zeroes the sum; cpu_felt_merge adds a range's part to the sum. */
void cpu_felt_begin(Cpu *cpu);
void cpu_felt_merge(Cpu *cpu, const CpuFelt *felt);

/* Adds to `felt` the impulse of the guard of `whom` on a particle at x (m): velocity `before` became v.
   Then sets `before` to v. `felt` NULL: adds nothing. */
void cpu_feel_guard(CpuFelt *felt, int whom, float mass, const float x[3], const float v[3], float before[3]);

#endif
