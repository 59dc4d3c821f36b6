/* Parallel loops of the CPU backend. */
#ifndef SLOSH_PARALLEL_H
#define SLOSH_PARALLEL_H

#include <stddef.h>

typedef void (*RangeFunction)(void *context, size_t begin, size_t end);

/* Calls function(context, begin, end) for the ranges [0, grain), [grain, 2 grain), ... of [0, count), in
   any order, on `threads` threads. The ranges are independent of the number of threads, and so are the
   results of a range. Within a range, denormal numbers count as 0 on each thread: computing with denormals
   takes several times as long, and a decaying flow is full of denormals. */
void parallel_ranges(int threads, size_t count, size_t grain, RangeFunction function, void *context);

/* Code between lock and unlock runs on a single thread at a time, over all ranges: for a short merge of
   order-independent results. Not recursive. */
void parallel_lock(void);
void parallel_unlock(void);

/* Number of processors available to OpenMP. */
int parallel_processors(void);

#endif
