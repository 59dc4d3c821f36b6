/* What a method's pass is on the CPU: loops over all particles, one behind the other, each in ranges side by
   side. */
#ifndef SLOSH_CPU_PASS_H
#define SLOSH_CPU_PASS_H

#include "sim/cpu/cpu.h"
#include "sim/world/method.h"
#include "sim/world/micro.h"

typedef struct CpuRange {
    Cpu *cpu;
    const PairArgs *args;
    const PassInput *input;
    size_t begin, end;
} CpuRange;

typedef struct CpuLoop {
    void (*body)(const CpuRange *range);
    bool walks; /* over neighbours */
    /* Before a walk, for all particles: fills Cpu.place, .motion or both as the walk needs them. NULL: both.
     */
    void (*pack)(const CpuRange *range);
    bool packed; /* the pass before has filled them */
    bool solids; /* over the particles of solids too; else over runs of the fluids' alone */
} CpuLoop;

typedef struct CpuPass {
    CpuLoop loops[3];                             /* ended by one without a body */
    PairCost (*pair)(const Constants *constants); /* counted as sim/world/micro.h says; NULL: no pairs */
} CpuPass;

/* The pair sums of a range. */
static inline void cpu_pairs(const CpuRange *range, const PairLoops *loops)
{
    loops->in[range->cpu->pairs](range->args, range->begin, range->end);
}

/* Forces as sums over pairs and walls become accelerations, surface tension among them. */
void cpu_force_end(const CpuRange *range);

#endif
