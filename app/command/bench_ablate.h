/* `slosh bench --ablate`. */
#ifndef SLOSH_BENCH_ABLATE_H
#define SLOSH_BENCH_ABLATE_H

#include "app/command/bench_plan.h"

/* Each scene of the plan without each of its terms; the exit code of the program. */
int bench_ablate(const Plan *plan);

#endif
