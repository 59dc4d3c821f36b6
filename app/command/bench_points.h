/* `slosh bench --table paper001`. */
#ifndef SLOSH_BENCH_POINTS_H
#define SLOSH_BENCH_POINTS_H

#include "app/command/bench_plan.h"

/* Measures sampling, then the table's scene; returns the exit code. */
int bench_points(const Plan *plan);

#endif
