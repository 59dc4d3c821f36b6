/* Sums and maxima over all ranks. Collective; all ranks get the same bits. */
#ifndef SLOSH_REDUCE_H
#define SLOSH_REDUCE_H

#include "sim/base/exact_sum.h"

#include <stddef.h>
#include <stdint.h>

/* Replaces each of `count` sums by the sum over all ranks: the same bits for any distribution of the terms.
   `count`: at most the number of sums felt by box and solids (sim/cpu/felt.h). */
void reduce_exact(ExactSum *sums, int count);

/* Maximum of each value; sum of each value, in doubles, for figures that no step reads; sum of an integer. */
void reduce_most(double *values, int count);
void reduce_sum(double *values, int count);
int64_t reduce_count(int64_t value);

/* Gathers each rank's `count` entries of `size` bytes in the order of the ranks, at `all` on each rank
   where `all` is not NULL. `all` needs room for the entries of all ranks. */
void reduce_gather(const void *own, size_t count, size_t size, void *all);

#endif
