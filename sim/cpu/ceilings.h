/* The machine's peak rates on some threads: the best of a few tries. */
#ifndef SLOSH_CEILINGS_H
#define SLOSH_CEILINGS_H

#include "sim/cpu/pair_set.h"
#include "sim/world/micro.h"

/* Returns false if memory is short. */
bool ceilings_measure(int threads, PairSet set, Ceilings *out);

#endif
