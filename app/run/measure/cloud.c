#include "app/run/measure/measure.h"

#include "sim/step/world.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool cloud_make(Cloud *cloud, size_t count)
{
    if (cloud->position && cloud->count == count)
        return true;
    cloud_free(cloud);
    cloud->position = malloc(count * 4 * sizeof(float) + 1);
    cloud->velocity = malloc(count * 4 * sizeof(float) + 1);
    cloud->density = malloc(count * sizeof(float) + 1);
    cloud->pressure = malloc(count * sizeof(float) + 1);
    cloud->fluid = malloc(count * sizeof(uint32_t) + 1);
    cloud->count = count;
    return cloud->position && cloud->velocity && cloud->density && cloud->pressure && cloud->fluid;
}

bool cloud_read(Cloud *cloud, World *world)
{
    WorldInfo info;
    world_info(world, &info);
    if (!cloud_make(cloud, world_held(world)))
        return false;
    cloud->spacing = info.spacing;
    cloud->support_radius = info.support_radius;
    ParticleArrays out = {.position = cloud->position, .velocity = cloud->velocity, .fluid = cloud->fluid};
    out.scalar[SCALAR_DENSITY] = cloud->density;
    out.scalar[SCALAR_PRESSURE] = cloud->pressure;
    return world_read(world, &out);
}

void cloud_free(Cloud *cloud)
{
    free(cloud->position);
    free(cloud->velocity);
    free(cloud->density);
    free(cloud->pressure);
    free(cloud->fluid);
    *cloud = (Cloud){.count = 0};
}

/* Particles chained by the hash of their cell, of side length `limit`; 0 ends a chain. */
typedef struct Chains {
    const float *position;
    double limit;
    size_t mask;
    uint32_t *first, *next; /* first of a chain; next of a particle: numbers from 1 on */
} Chains;

static size_t chain_of(const Chains *chains, const int64_t cell[3])
{
    const uint64_t hash = (uint64_t)cell[0] * 0x9e3779b97f4a7c15U ^ (uint64_t)cell[1] * 0xc2b2ae3d27d4eb4fU ^
                          (uint64_t)cell[2] * 0x165667b19e3779f9U;
    return (size_t)(hash ^ hash >> 29) & chains->mask;
}

static void cell_of(const Chains *chains, size_t i, int64_t cell[3])
{
    for (size_t k = 0; k < 3; k++)
        cell[k] = (int64_t)floor((double)chains->position[4 * i + k] / chains->limit);
}

static void put(const Chains *chains, size_t i)
{
    int64_t cell[3];
    cell_of(chains, i, cell);
    const size_t own = chain_of(chains, cell);
    chains->next[i] = chains->first[own];
    chains->first[own] = (uint32_t)i + 1;
}

static bool any_near(const Chains *chains, size_t chain, size_t i)
{
    const float *x = chains->position + 4 * i;
    for (size_t at = chains->first[chain]; at; at = chains->next[at - 1]) {
        const float *y = chains->position + 4 * (at - 1);
        double r2 = 0;
        for (int k = 0; k < 3; k++)
            r2 += ((double)x[k] - (double)y[k]) * ((double)x[k] - (double)y[k]);
        if (at != i + 1 && r2 < chains->limit * chains->limit)
            return true;
    }
    return false;
}

static bool is_close(const Chains *chains, size_t i)
{
    int64_t cell[3];
    bool close = false;
    cell_of(chains, i, cell);
    for (int n = 0; n < 27 && !close; n++)
        close = any_near(
            chains,
            chain_of(chains, (int64_t[]){cell[0] + n % 3 - 1, cell[1] + n / 3 % 3 - 1, cell[2] + n / 9 - 1}),
            i);
    return close;
}

/* True if the particle's cell index fits an integer. */
static bool is_somewhere(const float x[3], double limit)
{
    const double most = 1e15 * limit;
    return fabs((double)x[0]) < most && fabs((double)x[1]) < most && fabs((double)x[2]) < most;
}

/* Returns false if memory is short. */
static bool chains_make(Chains *chains, const Cloud *cloud, double limit)
{
    size_t count = 1;
    while (count < cloud->count)
        count *= 2;
    *chains = (Chains){cloud->position, limit, count - 1, calloc(count, sizeof(uint32_t)),
                       calloc(cloud->count + 1, sizeof(uint32_t))};
    const bool ok = chains->first && chains->next;
    for (size_t i = 0; ok && i < cloud->count; i++)
        if (is_somewhere(cloud->position + 4 * i, limit))
            put(chains, i);
    return ok;
}

static void chains_free(Chains *chains)
{
    free(chains->first);
    free(chains->next);
}

bool metric_close(const Cloud *cloud, double limit, size_t stride, size_t *close)
{
    Chains chains;
    const bool ok = chains_make(&chains, cloud, limit);
    *close = 0;
    for (size_t i = 0; ok && i < cloud->count; i += stride)
        *close += is_somewhere(cloud->position + 4 * i, limit) && is_close(&chains, i);
    chains_free(&chains);
    return ok;
}

/* Adds the velocities of neighbours of particle i from a cell's chain, weighted. Skips particles of other
   cells in the same chain, to avoid double counting. */
static void add_beside(const Chains *chains, const Cloud *cloud, const int64_t cell[3], size_t i,
                       double sum[4])
{
    const float *x = cloud->position + 4 * i;
    for (size_t at = chains->first[chain_of(chains, cell)]; at; at = chains->next[at - 1]) {
        const float *y = cloud->position + 4 * (at - 1), *v = cloud->velocity + 4 * (at - 1);
        int64_t own[3];
        double r2 = 0;
        cell_of(chains, at - 1, own);
        for (int k = 0; k < 3; k++)
            r2 += ((double)x[k] - (double)y[k]) * ((double)x[k] - (double)y[k]);
        if (at == i + 1 || r2 >= chains->limit * chains->limit || memcmp(own, cell, sizeof own) != 0)
            continue;
        const double weight = 1 - sqrt(r2) / chains->limit;
        for (int k = 0; k < 3; k++)
            sum[k] += weight * (double)v[k];
        sum[3] += weight;
    }
}

bool metric_common_motion(const Cloud *cloud, double h, size_t stride, double *common, double *kinetic)
{
    Chains chains;
    const bool ok = chains_make(&chains, cloud, h);
    *common = *kinetic = 0;
    for (size_t i = 0; ok && i < cloud->count; i += stride) {
        const float *v = cloud->velocity + 4 * i;
        double sum[4] = {0};
        int64_t cell[3];
        if (!is_somewhere(cloud->position + 4 * i, h))
            continue;
        cell_of(&chains, i, cell);
        for (int n = 0; n < 27; n++)
            add_beside(&chains, cloud,
                       (int64_t[]){cell[0] + n % 3 - 1, cell[1] + n / 3 % 3 - 1, cell[2] + n / 9 - 1}, i,
                       sum);
        for (int k = 0; k < 3; k++) {
            *kinetic += (double)v[k] * (double)v[k];
            *common += (double)v[k] * (sum[3] > 0 ? sum[k] / sum[3] : (double)v[k]);
        }
    }
    chains_free(&chains);
    return ok;
}

/* Bins of a constant ratio, so that a percentile has a constant relative accuracy. */
static const double LEAST = 1e-6, BINS_AN_OCTAVE = 64;

static int bin_of(double pressed)
{
    const double bin = pressed > LEAST ? BINS_AN_OCTAVE * log2(pressed / LEAST) : 0;
    return (int)fmin(bin, COMPRESSION_BINS - 1);
}

void compression_add(CompressionTally *tally, const Cloud *cloud, const WorldDef *def)
{
    for (size_t i = 0; i < cloud->count; i++) {
        const double rest = def->fluids[cloud->fluid[i]].density;
        const double change = (double)cloud->density[i] / rest - 1, pressed = fmax(change, 0);
        tally->sum += pressed;
        tally->most = fmax(tally->most, pressed);
        tally->thinned = fmax(tally->thinned, -change);
        tally->bins[bin_of(pressed)]++;
    }
    tally->particles += (double)cloud->count;
    tally->states++;
}

/* Returns the upper end of the percentile's bin. */
static double percentile(const CompressionTally *tally, double fraction)
{
    const double below = fraction * tally->particles;
    double count = 0;
    for (int b = 0; b < COMPRESSION_BINS; b++) {
        count += tally->bins[b];
        if (count >= below)
            return fmin(b == 0 ? 0 : LEAST * exp2((b + 1) / BINS_AN_OCTAVE), tally->most);
    }
    return tally->most;
}

CompressionFigures compression_figures(const CompressionTally *tally)
{
    if (tally->particles == 0)
        return (CompressionFigures){0};
    return (CompressionFigures){tally->sum / tally->particles, percentile(tally, 0.999), tally->most,
                                1 - tally->thinned};
}
