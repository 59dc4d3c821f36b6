#include "sim/dist/reduce.h"

#include "sim/cpu/felt.h"
#include "sim/dist/dist.h"

#include <stdlib.h>
#include <string.h>

/* Sums of energy, or of forces felt by box and solids. */
enum { SUMS_MOST = FELT_MOST * PUSH_NUMBERS };

void reduce_exact(ExactSum *sums, int count)
{
    int64_t words[SUMS_MOST][EXACT_WORDS];
    for (int k = 0; k < count; k++)
        exact_to_words(&sums[k], words[k]);
    MPI_Allreduce(MPI_IN_PLACE, words, count * EXACT_WORDS, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
    for (int k = 0; k < count; k++)
        exact_from_words(words[k], &sums[k]);
}

void reduce_most(double *values, int count)
{
    MPI_Allreduce(MPI_IN_PLACE, values, count, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
}

void reduce_sum(double *values, int count)
{
    MPI_Allreduce(MPI_IN_PLACE, values, count, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
}

int64_t reduce_count(int64_t value)
{
    MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
    return value;
}

static int *counts_of_all(size_t count, int ranks, int **offsets)
{
    int own = (int)count, *counts = malloc(2 * (size_t)ranks * sizeof *counts);
    if (!counts)
        dist_die("no memory");
    MPI_Allgather(&own, 1, MPI_INT, counts, 1, MPI_INT, MPI_COMM_WORLD);
    *offsets = counts + ranks;
    for (int r = 0, sum = 0; r < ranks; sum += counts[r++])
        (*offsets)[r] = sum;
    return counts;
}

void reduce_gather(const void *own, size_t count, size_t size, void *all)
{
    int ranks, *offsets;
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    int *counts = counts_of_all(count, ranks, &offsets), wants = all != NULL,
        *who = malloc((size_t)ranks * sizeof *who);
    MPI_Datatype entry;
    if (!who)
        dist_die("no memory");
    MPI_Allgather(&wants, 1, MPI_INT, who, 1, MPI_INT, MPI_COMM_WORLD);
    MPI_Type_contiguous((int)size, MPI_BYTE, &entry);
    MPI_Type_commit(&entry);
    for (int r = 0; r < ranks; r++)
        if (who[r])
            MPI_Gatherv(own, (int)count, entry, all, counts, offsets, entry, r, MPI_COMM_WORLD);
    MPI_Type_free(&entry);
    free(counts);
    free(who);
}
