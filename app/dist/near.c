#include "app/dist/near.h"

#include "sim/dist/dist.h"
#include "sim/dist/ranks.h"
#include "sim/dist/reduce.h"

#include <stdlib.h>
#include <string.h>

typedef struct Record {
    ParticleId id;
    uint32_t cell;
    float position[4], velocity[4], density, pressure;
} Record;

/* Allocates memory for `room` entries; old contents are lost. */
static void reserve(void *memory, size_t room, size_t size)
{
    void *at;
    memcpy(&at, memory, sizeof at);
    free(at);
    at = malloc(room * size);
    if (!at)
        dist_die("no memory for the probes; use fewer of them, or a larger spacing");
    memcpy(memory, &at, sizeof at);
}

static bool grows(size_t *room, size_t count)
{
    if (count < *room)
        return false;
    *room = count + count / 4 + 256;
    return true;
}

static void reserve_cloud(Cloud *cloud, size_t room)
{
    reserve(&cloud->position, room, 4 * sizeof *cloud->position);
    reserve(&cloud->velocity, room, 4 * sizeof *cloud->velocity);
    reserve(&cloud->density, room, sizeof *cloud->density);
    reserve(&cloud->pressure, room, sizeof *cloud->pressure);
}

static void read_own(Near *near, World *world)
{
    const size_t count = ranks_owned();
    if (grows(&near->own_room, count)) {
        reserve_cloud(&near->own, near->own_room);
        reserve(&near->id, near->own_room, sizeof *near->id);
        reserve(&near->cell, near->own_room, sizeof *near->cell);
    }
    ParticleArrays out = {
        .position = near->own.position, .velocity = near->own.velocity, .whole_id = near->id};
    out.scalar[SCALAR_DENSITY] = near->own.density;
    out.scalar[SCALAR_PRESSURE] = near->own.pressure;
    near->own.count = count;
    if (!world_read(world, &out))
        dist_die("no memory to read %zu particles; use a larger spacing", count);
    ranks_cells(near->cell);
}

/* Collects this rank's records; returns their count. */
static size_t choose(Near *near, const Probes *probes)
{
    const Cloud *own = &near->own;
    size_t count = 0;
    for (size_t i = 0; i < own->count; i++)
        count += probes_cover(probes, own->position + 4 * i);
    if (grows(&near->out_room, count))
        reserve(&near->out, near->out_room, sizeof(Record));
    Record *record = near->out;
    for (size_t i = 0; i < own->count; i++) {
        if (!probes_cover(probes, own->position + 4 * i))
            continue;
        *record = (Record){.cell = near->cell[i],
                           .id = near->id[i],
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

static void put(Near *near, Record *record, size_t count)
{
    Cloud *cloud = &near->cloud;
    if (grows(&near->cloud_room, count))
        reserve_cloud(cloud, near->cloud_room);
    qsort(record, count, sizeof *record, by_place);
    cloud->count = count;
    for (size_t i = 0; i < count; i++, record++) {
        memcpy(cloud->position + 4 * i, record->position, sizeof record->position);
        memcpy(cloud->velocity + 4 * i, record->velocity, sizeof record->velocity);
        cloud->density[i] = record->density;
        cloud->pressure[i] = record->pressure;
    }
}

void near_read(Near *near, const Probes *probes, World *world)
{
    int rank;
    WorldInfo info;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    read_own(near, world);
    const size_t count = choose(near, probes), all = (size_t)reduce_count((int64_t)count);
    if (rank == 0 && grows(&near->in_room, all))
        reserve(&near->in, near->in_room, sizeof(Record));
    reduce_gather(near->out, count, sizeof(Record), rank == 0 ? near->in : NULL);
    if (rank > 0)
        return;
    world_info(world, &info);
    near->cloud.spacing = info.spacing;
    near->cloud.support_radius = info.support_radius;
    put(near, near->in, all);
}

void near_free(Near *near)
{
    cloud_free(&near->cloud);
    cloud_free(&near->own);
    free(near->out);
    free(near->in);
    free(near->id);
    free(near->cell);
    *near = (Near){.out = NULL};
}
