/* `slosh bench --micro`. */
#ifndef SLOSH_BENCH_MICRO_H
#define SLOSH_BENCH_MICRO_H

#include "app/command/bench_plan.h"

/* Measures the plan's cases; returns the exit code. */
int bench_micro(const Plan *plan);

#endif
