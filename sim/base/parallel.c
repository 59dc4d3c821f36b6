#include "sim/base/base.h"

#include <omp.h>
#include <pthread.h>
#include <stdint.h>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

static pthread_mutex_t merging = PTHREAD_MUTEX_INITIALIZER;

/* Treats denormal numbers as 0, as operands and results, until the old mode is restored. */
#if defined(__SSE2__)
typedef unsigned Mode;

static Mode flush_denormals(void)
{
    const Mode before = _mm_getcsr();
    _mm_setcsr(before | 0x8040); /* flush to zero, denormals are zero */
    return before;
}

static void set_mode(Mode mode)
{
    _mm_setcsr(mode);
}
#elif defined(__aarch64__)
typedef uint64_t Mode;

static void set_mode(Mode mode)
{
    __asm__ volatile("msr fpcr, %0" : : "r"(mode));
}

static Mode flush_denormals(void)
{
    Mode before;
    __asm__ volatile("mrs %0, fpcr" : "=r"(before));
    set_mode(before | UINT64_C(1) << 24); /* FZ */
    return before;
}
#else
typedef int Mode;

static Mode flush_denormals(void)
{
    return 0;
}

static void set_mode(Mode mode)
{
    (void)mode;
}
#endif

void parallel_ranges(int threads, size_t count, size_t grain, RangeFunction function, void *context)
{
    const long ranges = (long)((count + grain - 1) / grain);
#pragma omp parallel num_threads(threads) if (ranges > 1 && threads > 1)
    {
        const Mode before = flush_denormals();
#pragma omp for schedule(dynamic, 1)
        for (long r = 0; r < ranges; r++) {
            const size_t begin = (size_t)r * grain, end = begin + grain;
            function(context, begin, end < count ? end : count);
        }
        set_mode(before);
    }
}

int parallel_processors(void)
{
    return omp_get_num_procs();
}

/* No OpenMP critical section: with a tool, libomp then reads the first thread's record, even after the
   thread has ended. */
void parallel_lock(void)
{
    pthread_mutex_lock(&merging);
}

void parallel_unlock(void)
{
    pthread_mutex_unlock(&merging);
}
