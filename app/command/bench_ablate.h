/* `slosh bench --ablate`. */
#ifndef SLOSH_BENCH_ABLATE_H
#define SLOSH_BENCH_ABLATE_H

#include "app/command/bench_plan.h"

/* Measures each scene of the plan without each of its terms; returns the exit code. */
int bench_ablate(const Plan *plan);

#endif
