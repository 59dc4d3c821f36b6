#include "sim/base/parallel.h"

#include <omp.h>
#include <pthread.h>

static pthread_mutex_t merging = PTHREAD_MUTEX_INITIALIZER;

void parallel_ranges(int threads, size_t count, size_t grain, RangeFunction function, void *context)
{
    const long ranges = (long)((count + grain - 1) / grain);
#pragma omp parallel for num_threads(threads) schedule(dynamic, 1) if (ranges > 1 && threads > 1)
    for (long r = 0; r < ranges; r++) {
        const size_t begin = (size_t)r * grain, end = begin + grain;
        function(context, begin, end < count ? end : count);
    }
}

int parallel_processors(void)
{
    return omp_get_num_procs();
}

/* No OpenMP critical section: libomp with a tool reads the first thread's record there, also when that
   thread has ended. */
void parallel_lock(void)
{
    pthread_mutex_lock(&merging);
}

void parallel_unlock(void)
{
    pthread_mutex_unlock(&merging);
}
