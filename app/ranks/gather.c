#include "app/ranks/ranks.h"

#include "sim/ranks/ranks.h"
#include "sim/world.h"

#include <mpi.h>
#include <stdlib.h>
#include <string.h>

typedef struct Record {
    ParticleId id;
    uint32_t cell;
    float position[4], velocity[4], density, pressure;
} Record;

/* Allocates memory for `room` entries; old contents are lost. */
static void reserve(void *memory, size_t capacity, size_t size)
{
    void *at;
    memcpy(&at, memory, sizeof at);
    free(at);
    at = malloc(capacity * size);
    if (!at)
        dist_die("no memory for the probes; use fewer of them, or a larger spacing");
    memcpy(memory, &at, sizeof at);
}

static bool grows(size_t *capacity, size_t count)
{
    if (count < *capacity)
        return false;
    *capacity = count + count / 4 + 256;
    return true;
}

static void reserve_cloud(Cloud *cloud, size_t capacity)
{
    reserve(&cloud->position, capacity, 4 * sizeof *cloud->position);
    reserve(&cloud->velocity, capacity, 4 * sizeof *cloud->velocity);
    reserve(&cloud->density, capacity, sizeof *cloud->density);
    reserve(&cloud->pressure, capacity, sizeof *cloud->pressure);
}

static void read_own(Gathered *gathered, World *world)
{
    const bool read = cloud_read(&gathered->own, world);
    const size_t count = gathered->own.count;
    if (grows(&gathered->own_capacity, count)) {
        reserve(&gathered->id, gathered->own_capacity, sizeof *gathered->id);
        reserve(&gathered->cell, gathered->own_capacity, sizeof *gathered->cell);
    }
    if (!read || !world_read(world, &(ParticleArrays){.whole_id = gathered->id}))
        dist_die("no memory to read %zu particles; use a larger spacing", count);
    ranks_cells(gathered->cell);
}

/* Collects this rank's records; returns their count. */
static size_t choose(Gathered *gathered, const Probes *probes)
{
    const Cloud *own = &gathered->own;
    size_t count = 0;
    for (size_t i = 0; i < own->count; i++)
        count += probes_cover(probes, own->position + 4 * i);
    if (grows(&gathered->out_capacity, count))
        reserve(&gathered->out, gathered->out_capacity, sizeof(Record));
    Record *record = gathered->out;
    for (size_t i = 0; i < own->count; i++) {
        if (!probes_cover(probes, own->position + 4 * i))
            continue;
        *record = (Record){.cell = gathered->cell[i],
                           .id = gathered->id[i],
                           .density = own->density[i],
                           .pressure = own->pressure[i]};
        memcpy(record->position, own->position + 4 * i, sizeof record->position);
        memcpy(record++->velocity, own->velocity + 4 * i, sizeof record->velocity);
    }
    return count;
}

static int by_place(const void *a, const void *b)
{
    const Record *p = a, *q = b;
    const int cells = (p->cell > q->cell) - (p->cell < q->cell);
    return cells ? cells : (p->id > q->id) - (p->id < q->id);
}

static void put(Gathered *gathered, Record *record, size_t count)
{
    Cloud *cloud = &gathered->cloud;
    if (grows(&gathered->cloud_capacity, count))
        reserve_cloud(cloud, gathered->cloud_capacity);
    qsort(record, count, sizeof *record, by_place);
    cloud->count = count;
    for (size_t i = 0; i < count; i++, record++) {
        memcpy(cloud->position + 4 * i, record->position, sizeof record->position);
        memcpy(cloud->velocity + 4 * i, record->velocity, sizeof record->velocity);
        cloud->density[i] = record->density;
        cloud->pressure[i] = record->pressure;
    }
}

const Cloud *dist_gather(void *user, const Probes *probes, World *world)
{
    int rank;
    Gathered *gathered = user;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    read_own(gathered, world);
    const size_t count = choose(gathered, probes), all = (size_t)reduce_count((int64_t)count);
    if (rank == 0 && grows(&gathered->in_capacity, all))
        reserve(&gathered->in, gathered->in_capacity, sizeof(Record));
    reduce_gather(gathered->out, count, sizeof(Record), rank == 0 ? gathered->in : NULL);
    if (rank > 0)
        return NULL;
    gathered->cloud.spacing = gathered->own.spacing;
    gathered->cloud.support_radius = gathered->own.support_radius;
    put(gathered, gathered->in, all);
    return &gathered->cloud;
}

void dist_gather_free(Gathered *gathered)
{
    cloud_free(&gathered->cloud);
    cloud_free(&gathered->own);
    free(gathered->out);
    free(gathered->in);
    free(gathered->id);
    free(gathered->cell);
    *gathered = (Gathered){.out = NULL};
}
