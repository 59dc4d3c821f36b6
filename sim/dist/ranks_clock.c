/* Times of a rank: computing, exchange, waiting. */
#include "sim/dist/ranks_state.h"

#include <time.h>

static double seconds(clockid_t clock)
{
    struct timespec now;
    clock_gettime(clock, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

Clock clock_now(void)
{
    return (Clock){MPI_Wtime(), seconds(CLOCK_PROCESS_CPUTIME_ID)};
}

void computed(Ranks *ranks, Clock since)
{
    ranks->figures.compute += MPI_Wtime() - since.wall;
    ranks->cpu_time += seconds(CLOCK_PROCESS_CPUTIME_ID) - since.cpu;
}

void not_computed(Ranks *ranks, Clock since)
{
    ranks->figures.compute -= MPI_Wtime() - since.wall;
    ranks->cpu_time -= seconds(CLOCK_PROCESS_CPUTIME_ID) - since.cpu;
}

void exchanged(Ranks *ranks, Clock since)
{
    const DistSent sent = dist_sent(ranks->dist);
    ranks->figures.exchange += MPI_Wtime() - since.wall;
    ranks->figures.sent += sent.bytes;
    ranks->figures.messages += sent.messages;
}

void wait_for_others(Ranks *ranks)
{
    const double begin = MPI_Wtime();
    if (dist_size(ranks->dist) > 1)
        MPI_Barrier(MPI_COMM_WORLD);
    ranks->figures.wait += MPI_Wtime() - begin;
}
