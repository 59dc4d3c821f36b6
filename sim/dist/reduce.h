/* Sums and greatest values over all ranks. Collective; all ranks get the same bits. */
#ifndef SLOSH_REDUCE_H
#define SLOSH_REDUCE_H

#include "sim/base/exact_sum.h"

#include <stddef.h>
#include <stdint.h>

/* Each of `count` sums becomes that of all ranks: the same bits whoever has which part. As many at most as
   box and solids feel (sim/cpu/felt.h). */
void reduce_exact(ExactSum *sums, int count);

/* The greatest of each; sums, in doubles, for figures that no step reads; whole numbers. */
void reduce_most(double *values, int count);
void reduce_sum(double *values, int count);
int64_t reduce_count(int64_t value);

/* A rank's `count` entries of `size` bytes, behind those of the ranks before it: at `all` on each rank that
   has one (not NULL), with room for those of all ranks. */
void reduce_gather(const void *own, size_t count, size_t size, void *all);

#endif
