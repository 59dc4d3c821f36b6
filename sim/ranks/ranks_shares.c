/* Times of a rank: computing, exchange, waiting; and the shares of the ranks, made anew by these times. */
#include "sim/ranks/ranks_private.h"

#include <stdlib.h>
#include <time.h>

/* ---- clocks ---- */

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

/* ---- shares ---- */

/* Cells are shared out again if the slowest rank takes more than UNEVEN times the mean time.
   The time lost since the last sharing must also exceed TAKES times the cost of sharing: moved particles
   cost about as much again. */
static const double UNEVEN = 1.05, TAKES = 2;

static bool balances = true;

void ranks_balance(bool on)
{
    balances = on;
}

bool is_own(const Dist *dist, const Constants *constants, const float *x)
{
    return dist_owner(dist, cpu_cell_of(constants, x)) == dist_rank(dist);
}

void share_first(Ranks *ranks, const Constants *constants, const InitialState *initial)
{
    const Clock begin = clock_now();
    for (size_t cell = 0; initial->count == 0 && cell < constants->cells.count; cell++)
        ranks->weight[cell] = 1;
    for (size_t i = 0; i < initial->count; i++)
        ranks->weight[cpu_cell_of(constants, initial->position + 3 * i)]++;
    dist_balance(ranks->dist, ranks->weight, true);
    ranks->took = clock_now().cpu - begin.cpu;
}

/* Call after cpu_cells. Weight of each own cell: its particles, each at the rank's mean time per particle
   and step. */
static void weigh(Ranks *ranks)
{
    const Cpu *cpu = ranks->cpu;
    const uint8_t *foreign = dist_foreign(ranks->dist);
    const double each = ranks->cpu_time / (ranks->worked > 0 ? ranks->worked : 1);
    for (size_t cell = 0; cell < cpu->constants->cells.count; cell++)
        ranks->weight[cell] = 0;
    for (size_t i = 0; i < cpu->count; i++) {
        const uint32_t cell = cpu->spare_cell[i];
        if (cpu_owns(cpu, i) && !foreign[cell])
            ranks->weight[cell] += each;
    }
}

void share_anew(Ranks *ranks)
{
    const Clock begin = clock_now();
    weigh(ranks);
    dist_balance(ranks->dist, ranks->weight, false);
    ranks->due = false;
    ranks->cpu_time = ranks->worked = 0;
    ranks->figures.balances++;
    const Clock end = clock_now();
    ranks->took = end.cpu - begin.cpu;
    ranks->figures.balance += end.wall - begin.wall;
}

void look_at_shares(Ranks *ranks)
{
    /* The least time of all ranks is the cost of sharing: a late rank or a rank on a shared core waits and
       would raise the cost. */
    double most[2] = {ranks->cpu_time, -ranks->took}, mean = ranks->cpu_time;
    if (!balances || dist_size(ranks->dist) == 1)
        return;
    reduce_most(most, 2);
    reduce_sum(&mean, 1);
    mean /= dist_size(ranks->dist);
    ranks->due = most[0] > UNEVEN * mean && (most[0] - mean) / ranks->cpu->threads > TAKES * -most[1];
}

/* ---- memory ---- */

void *some(const void *wanted, size_t count, size_t size)
{
    void *memory = wanted ? malloc((count + 1) * size) : NULL;
    if (wanted && !memory)
        dist_die("no memory for %zu particles; use more ranks or a larger spacing", count);
    return memory;
}

size_t room_for(size_t count, int size)
{
    return size == 1 ? count : count + count / 8 + 1024;
}
