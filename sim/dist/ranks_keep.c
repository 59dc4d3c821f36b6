/* States: read and marked by each rank alone, saved and loaded by all ranks together. */
#include "sim/dist/ranks_state.h"
#include "sim/dist/reduce.h"

#include <stdlib.h>
#include <string.h>

bool ranks_read(void *state, const ParticleArrays *out)
{
    return cpu_read(((Ranks *)state)->cpu, out);
}

size_t ranks_held(const void *state)
{
    return ((const Ranks *)state)->cpu->owned;
}

bool ranks_save(void *state, const ParticleColumns *to)
{
    Ranks *ranks = state;
    Cpu *cpu = ranks->cpu;
    ParticleColumns from = {.x = NULL}, out = *to;
    if (!columns_create(&from, &cpu->saved, cpu->owned, NULL))
        dist_die("no memory for the state of %zu particles", cpu->owned);
    backend_cpu.save(cpu, &from);
    for (int r = 0; r < cpu->saved.count; r++)
        for (int c = 0; c < cpu->saved.row[r]->components; c++)
            reduce_gather(*column_array(&from, cpu->saved.row[r], c), cpu->owned,
                          column_size(cpu->saved.row[r]), *column_array(&out, cpu->saved.row[r], c));
    columns_destroy(&from);
    return true;
}

/* ---- load, mark and back ---- */

static void start_with(Ranks *ranks, size_t count, size_t guarded)
{
    Cpu *cpu = ranks->cpu;
    cpu->count = cpu->owned = count;
    if (cpu->boundary_at)
        cpu_boundary_append(cpu);
    if (cpu->ghost)
        memset(cpu->ghost, 0, cpu->count);
    cpu->guarded = 0;
    ranks->began_guarded = ranks->guarded = guarded;
    ranks->fresh = 0;
}

/* Drops the ghosts and makes room for `count` own particles. */
static void make_room(Ranks *ranks, size_t count)
{
    Cpu *cpu = ranks->cpu;
    const size_t all = count + cpu->constants->boundary.count;
    dist_drop(ranks->dist, cpu);
    if (all > cpu->capacity && !cpu_grow(cpu, room_for(all, 2)))
        dist_die("no memory for %zu particles; use more ranks or a larger spacing", all);
}

bool ranks_load(void *state, const ParticleColumns *from, size_t count, size_t guarded)
{
    Ranks *ranks = state;
    Cpu *cpu = ranks->cpu;
    uint32_t *own = malloc((count + 1) * sizeof *own);
    size_t owned = 0;
    if (!own)
        dist_die("no memory for %zu particles", count);
    for (size_t i = 0; i < count; i++)
        if (is_own(ranks->dist, cpu->constants, (float[]){from->x[i], from->y[i], from->z[i]}))
            own[owned++] = (uint32_t)i;
    make_room(ranks, owned);
    columns_copy(&cpu->saved, from, &cpu->now, own, 0, owned);
    free(own);
    ranks->total = count;
    start_with(ranks, owned, guarded);
    return true;
}

bool ranks_mark(void *state, Error *error)
{
    Ranks *ranks = state;
    Cpu *cpu = ranks->cpu;
    (void)error;
    look_at_shares(ranks);
    if (cpu->owned > ranks->kept_room || !ranks->kept.x) {
        columns_destroy(&ranks->kept);
        ranks->kept_room = cpu->owned + cpu->owned / 16 + 16;
    }
    if (!columns_create(&ranks->kept, &cpu->saved, ranks->kept_room, NULL))
        dist_die("no memory for the state of %zu particles", cpu->owned);
    ranks->kept_count = cpu->owned;
    return backend_cpu.save(cpu, &ranks->kept);
}

void ranks_back(void *state, size_t count, size_t guarded)
{
    Ranks *ranks = state;
    Cpu *cpu = ranks->cpu;
    make_room(ranks, ranks->kept_count);
    columns_copy(&cpu->saved, &ranks->kept, &cpu->now, NULL, 0, ranks->kept_count);
    ranks->total = count;
    start_with(ranks, ranks->kept_count, guarded);
}
