/* What this machine could do at most, on some threads together: the best of a few tries. */
#ifndef SLOSH_CEILINGS_H
#define SLOSH_CEILINGS_H

#include "sim/cpu/pair_set.h"
#include "sim/world/micro.h"

/* False when memory is short. */
bool ceilings_measure(int threads, PairSet set, Ceilings *out);

#endif
