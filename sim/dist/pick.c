/* Picks the few particles of a rank to send. */
#include "sim/dist/dist_state.h"

#include <string.h>

enum { PICK_GRAIN = 4 * CPU_GRAIN };

typedef struct Pick {
    const Cpu *cpu;
    const uint8_t *marked;
    uint32_t *found, *count; /* indices, from the begin of each range; number per range */
} Pick;

static void pick_range(void *context, size_t begin, size_t end)
{
    const Pick *pick = context;
    const uint32_t *cell = pick->cpu->spare_cell;
    uint32_t *found = pick->found + begin;
    for (size_t i = begin; i < end; i++)
        if (pick->marked[cell[i]] && pick->cpu->now.fluid[i] < FLUIDS_MAX)
            *found++ = (uint32_t)i;
    pick->count[begin / PICK_GRAIN] = (uint32_t)(found - (pick->found + begin));
}

size_t dist_pick(Dist *dist, Cpu *cpu, const uint8_t *marked)
{
    const size_t ranges = (cpu->count + PICK_GRAIN - 1) / PICK_GRAIN;
    size_t count = 0;
    dist_reserve(&dist->ranges, &dist->ranges_room, ranges * sizeof *dist->ranges);
    Pick pick = {cpu, marked, cpu->rank, dist->ranges};
    parallel_ranges(cpu->threads, cpu->count, PICK_GRAIN, pick_range, &pick);
    for (size_t r = 0; r < ranges; count += dist->ranges[r++])
        memmove(pick.found + count, pick.found + r * PICK_GRAIN, dist->ranges[r] * sizeof *pick.found);
    return count;
}
