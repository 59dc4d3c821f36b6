#include "sim/cpu/neighbour_lists.h"

#include <stdlib.h>
#include <string.h>

/* Expected rows of a group whose particles have `neighbours` neighbours on average. */
static double rows_expected(double neighbours)
{
    return 1.2 * neighbours + 8;
}

static bool fit(ListMemory *memory, size_t indices)
{
    if (indices > UINT32_MAX)
        return false;
    uint32_t *index = aligned_alloc(64, (indices * sizeof *index + 63) / 64 * 64);
    if (!index)
        return false;
    if (memory->index)
        memcpy(index, memory->index, memory->room * sizeof *index);
    free(memory->index);
    *memory = (ListMemory){index, (uint32_t)indices};
    return true;
}

bool neighbour_lists_create(NeighbourLists *lists, size_t particles, double neighbours)
{
    lists->ranges = particles / LISTS_GRAIN + 1;
    const size_t groups = particles / LANES + 1;
    lists->of_range = calloc(lists->ranges, sizeof *lists->of_range);
    lists->found = calloc(lists->ranges, sizeof *lists->found);
    lists->of_images = calloc(lists->ranges, sizeof *lists->of_images);
    lists->first = calloc(groups, sizeof *lists->first);
    lists->rows = calloc(groups, sizeof *lists->rows);
    lists->images = calloc(groups, sizeof *lists->images);
    bool ok =
        lists->of_range && lists->found && lists->of_images && lists->first && lists->rows && lists->images;
    for (size_t r = 0; ok && r < lists->ranges; r++) {
        const size_t left = particles - r * LISTS_GRAIN, in_range = left < LISTS_GRAIN ? left : LISTS_GRAIN;
        ok = fit(&lists->of_range[r], (size_t)((double)in_range * rows_expected(neighbours)) + LANES * LANES);
    }
    return ok;
}

static void free_ranges(ListMemory *of_range, size_t ranges)
{
    for (size_t r = 0; of_range && r < ranges; r++)
        free(of_range[r].index);
    free(of_range);
}

void neighbour_lists_destroy(NeighbourLists *lists)
{
    free_ranges(lists->of_range, lists->ranges);
    free_ranges(lists->found, lists->ranges);
    free_ranges(lists->of_images, lists->ranges);
    free(lists->first);
    free(lists->rows);
    free(lists->images);
}

size_t neighbour_lists_bytes(const NeighbourLists *lists)
{
    size_t indices = 3 * lists->ranges * (LISTS_GRAIN / LANES);
    for (size_t r = 0; r < lists->ranges; r++)
        indices += (size_t)lists->of_range[r].room + lists->found[r].room + lists->of_images[r].room;
    return indices * sizeof(uint32_t);
}

bool neighbour_lists_fit(NeighbourLists *lists, ListMemory *memory, size_t indices)
{
    if (indices <= memory->room || fit(memory, indices + indices / 2))
        return true;
    __atomic_store_n(&lists->full, true, __ATOMIC_RELAXED);
    return false;
}
