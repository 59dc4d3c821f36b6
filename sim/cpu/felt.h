/* What box and solids feel, as sums that have the same bits whoever adds up which part: of cells of particles
   in double, and of these exactly. */
#ifndef SLOSH_CPU_FELT_H
#define SLOSH_CPU_FELT_H

#include "sim/cpu/cpu.h"

enum { PUSH_NUMBERS = sizeof(Push) / sizeof(double), FELT_MOST = SOLIDS_MAX + 1 };

typedef struct PushSum {
    ExactSum number[PUSH_NUMBERS];
} PushSum;

/* A part, of a range. Only `any` needs to be false before. */
typedef struct CpuFelt {
    bool any;
    PushSum of[FELT_MOST]; /* the box, then each solid */
} CpuFelt;

/* Adds a push to the box (0) or to a solid (1 + its number). */
void cpu_felt_add(CpuFelt *felt, int whom, const Push *push);

/* Zeroes the sum; adds a range's part to it. */
void cpu_felt_begin(Cpu *cpu);
void cpu_felt_merge(Cpu *cpu, const CpuFelt *felt);

/* Adds to a part what a guard of `whom` at x (m) did to a velocity, `before`, which then becomes v; NULL:
   adds nothing. */
void cpu_feel_guard(CpuFelt *felt, int whom, float mass, const float x[3], const float v[3], float before[3]);

#endif
