/* Emitters and drains on ranks. */
#include "sim/dist/ranks_state.h"
#include "sim/dist/reduce.h"

#include <stdlib.h>
#include <string.h>

/* True if no particle emitted since the grid, on any rank, is near x. */
static bool clear_of_others(const Ranks *ranks, const float x[3])
{
    const Constants *s = ranks->cpu->constants;
    const float least = 0.9f * s->spacing; /* same value as in sim/cpu/flow.c */
    for (size_t k = 0; k < ranks->came_count; k++) {
        const float *other = ranks->came + 3 * k;
        float d[3] = {x[0] - other[0], x[1] - other[1], x[2] - other[2]};
        periodic_nearest(&s->periodic, d);
        if (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < least * least)
            return false;
    }
    return true;
}

/* Records a position where a foreign rank emitted a particle since the grid. */
static void note(Ranks *ranks, const float x[3])
{
    if (ranks->came_count == ranks->came_room) {
        ranks->came_room = 2 * ranks->came_room + 256;
        ranks->came = realloc(ranks->came, ranks->came_room * 3 * sizeof *ranks->came);
        if (!ranks->came)
            dist_die("no memory for the particles that come");
    }
    memcpy(ranks->came + 3 * ranks->came_count++, x, 3 * sizeof *x);
}

/* If a rank lacks room, grows the arrays on all ranks and builds the grid again, because growing loses the
   grid. */
static void room_to_emit(Ranks *ranks, size_t count)
{
    Cpu *cpu = ranks->cpu;
    double full = cpu->count + count > cpu->capacity;
    reduce_most(&full, 1);
    if (full == 0)
        return;
    dist_drop(ranks->dist, cpu);
    if (!cpu_grow(cpu, room_for(cpu->count + count, 2)))
        dist_die("no memory for the particles that come");
    ranks_grid(ranks);
}

/* The owner of a position's cell decides if there is room. Positions of a layer are a spacing apart and
   need no check among themselves. */
size_t ranks_emit(void *state, const EmitLayer *layer, size_t most)
{
    Ranks *ranks = state;
    Cpu *cpu = ranks->cpu;
    size_t number = 0;
    double *room = some(layer, layer->count, sizeof *room);
    room_to_emit(ranks, layer->count);
    for (size_t k = 0; k < layer->count; k++) {
        const float *x = layer->position + 3 * k;
        room[k] = walls_contain(&cpu->constants->walls, x) && is_own(ranks->dist, cpu->constants, x) &&
                  cpu_has_room(cpu, x) && clear_of_others(ranks, x);
    }
    reduce_most(room, (int)layer->count);
    for (size_t k = 0; k < layer->count && number < most; k++) {
        const float *x = layer->position + 3 * k;
        if (room[k] == 0)
            continue;
        if (is_own(ranks->dist, cpu->constants, x))
            cpu_append(cpu, layer, x, number);
        else
            note(ranks, x);
        number++;
    }
    free(room);
    ranks->total += number;
    return number;
}

size_t ranks_drain(void *state, const Fill *regions, int count)
{
    Ranks *ranks = state;
    const size_t gone = (size_t)reduce_count((int64_t)cpu_drain(ranks->cpu, regions, count));
    ranks->total -= gone;
    return gone;
}
