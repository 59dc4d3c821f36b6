#include "app/metric/closeness.h"

#include <math.h>
#include <stdlib.h>

/* Particles chained by the hash of their cell, whose sides are the limit long; 0 ends a chain. */
typedef struct Chains {
    const float *position;
    double limit;
    size_t mask;
    uint32_t *first, *next; /* a chain; a particle: numbers from 1 on */
    uint8_t *close;         /* a particle */
} Chains;

static size_t chain_of(const Chains *chains, const int64_t cell[3])
{
    const uint64_t hash = (uint64_t)cell[0] * 0x9e3779b97f4a7c15U ^ (uint64_t)cell[1] * 0xc2b2ae3d27d4eb4fU ^
                          (uint64_t)cell[2] * 0x165667b19e3779f9U;
    return (size_t)(hash ^ hash >> 29) & chains->mask;
}

static void look_along(const Chains *chains, size_t chain, size_t i)
{
    const float *x = chains->position + 4 * i;
    for (size_t at = chains->first[chain]; at; at = chains->next[at - 1]) {
        const float *y = chains->position + 4 * (at - 1);
        double r2 = 0;
        for (int k = 0; k < 3; k++)
            r2 += ((double)x[k] - (double)y[k]) * ((double)x[k] - (double)y[k]);
        if (r2 < chains->limit * chains->limit)
            chains->close[i] = chains->close[at - 1] = 1;
    }
}

/* Against all before it in the cells around; then into its own. */
static void take(const Chains *chains, size_t i)
{
    int64_t cell[3], at[3];
    for (int k = 0; k < 3; k++)
        cell[k] = (int64_t)floor((double)chains->position[4 * i + (size_t)k] / chains->limit);
    for (int n = 0; n < 27; n++) {
        at[0] = cell[0] + n % 3 - 1;
        at[1] = cell[1] + n / 3 % 3 - 1;
        at[2] = cell[2] + n / 9 - 1;
        look_along(chains, chain_of(chains, at), i);
    }
    const size_t own = chain_of(chains, cell);
    chains->next[i] = chains->first[own];
    chains->first[own] = (uint32_t)i + 1;
}

/* Whether its cell has a number. */
static bool is_somewhere(const float x[3], double limit)
{
    const double most = 1e15 * limit;
    return fabs((double)x[0]) < most && fabs((double)x[1]) < most && fabs((double)x[2]) < most;
}

bool metric_close(const Cloud *cloud, double limit, size_t *close)
{
    size_t chains_count = 1;
    while (chains_count < cloud->count)
        chains_count *= 2;
    Chains chains = {cloud->position,
                     limit,
                     chains_count - 1,
                     calloc(chains_count, sizeof(uint32_t)),
                     calloc(cloud->count + 1, sizeof(uint32_t)),
                     calloc(cloud->count + 1, 1)};
    const bool ok = chains.first && chains.next && chains.close;
    *close = 0;
    for (size_t i = 0; ok && i < cloud->count; i++)
        if (is_somewhere(cloud->position + 4 * i, limit))
            take(&chains, i);
    for (size_t i = 0; ok && i < cloud->count; i++)
        *close += chains.close[i];
    free(chains.first);
    free(chains.next);
    free(chains.close);
    return ok;
}
