/* The one way in which the CPU backend runs in parallel. */
#ifndef SLOSH_PARALLEL_H
#define SLOSH_PARALLEL_H

#include <stddef.h>

typedef void (*RangeFunction)(void *context, size_t begin, size_t end);

/* Calls function(context, begin, end) for the ranges [0, grain), [grain, 2 grain), ... of [0, count), in any
   order, on `threads` threads. The ranges do not depend on the number of threads, so what a range computes
   does not either. Within a range denormal numbers count as 0, on each thread: computing with them takes
   several times as long, and a flow that dies out is full of them. */
void parallel_ranges(int threads, size_t count, size_t grain, RangeFunction function, void *context);

/* What stands between these two runs on one thread at a time, of all ranges: a short merge of results whose
   order does not matter. They do not nest. */
void parallel_lock(void);
void parallel_unlock(void);

/* Processors that OpenMP would use. */
int parallel_processors(void);

#endif
