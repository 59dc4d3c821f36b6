/* Lists by the program's own parts: it keeps the second way, and turns what it found. */
#include "eight.h"
#include "sim/cpu/lists_avx2.h"

/* Writes the list of particle i behind those that are there. */
SIMD_INLINE void list_end(Cloud *cloud, size_t i, const Writer *out)
{
    int32_t *first = (int32_t *)cloud->index + cloud->used;
    i8_store(out->at, i8_splat((int32_t)cloud->args.count));
    cloud->first[i] = (uint32_t)cloud->used;
    cloud->length[i] = (uint32_t)(out->at - first);
    cloud->used += (cloud->length[i] + LANES - 1) / LANES * LANES;
}

void lists_of_rows(Cloud *cloud)
{
    const PairArgs *a = &cloud->making;
    Run runs[RUNS];
    int count = 0;
    cloud->used = 0;
    for (size_t i = 0; i < a->count; i++) {
        if (i == 0 || a->cell[i] != a->cell[i - 1])
            count = cloud_runs(cloud, i, runs);
        Writer out = {.at = (int32_t *)cloud->index + cloud->used};
        for (const Run *run = runs; run < runs + count; run++)
            offer(a, i, a->x + run->begin, a->y + run->begin, a->z + run->begin, cloud->numbers + run->begin,
                  (int)(run->end - run->begin), &out);
        list_end(cloud, i, &out);
    }
}

/* Of the particles [begin, end) of one cell. */
static void block_of(const Cloud *cloud, size_t begin, size_t end, Block *block)
{
    Around box;
    Run runs[RUNS];
    const int count = cloud_runs(cloud, begin, runs);
    around(&cloud->making, begin, end, &box);
    block->count = 0;
    for (int k = 0; k < count; k++)
        block_add(&cloud->making, &box, runs[k].begin, runs[k].end, block);
}

/* Lists of [begin, end), which are in one cell; `half`: of those behind each alone, in a block that is in
   their order. */
SIMD_INLINE void lists_of_cell(Cloud *cloud, size_t begin, size_t end, const bool half)
{
    Block block;
    int from = 0;
    block_of(cloud, begin, end, &block);
    for (size_t i = begin; i < end; i++) {
        while (half && from < block.count && block.j[from] <= (int32_t)i)
            from++;
        Writer out = {.at = (int32_t *)cloud->index + cloud->used};
        offer(&cloud->making, i, block.x + from, block.y + from, block.z + from, block.j + from,
              block.count - from, &out);
        list_end(cloud, i, &out);
    }
}

SIMD_INLINE void lists_of(Cloud *cloud, size_t begin, size_t end, const bool half)
{
    const uint32_t *cell = cloud->args.cell;
    cloud->used = 0;
    for (size_t i = begin, stop; i < end; i = stop) {
        for (stop = i + 1; stop < end && cell[stop] == cell[i];)
            stop++;
        lists_of_cell(cloud, i, stop, half);
    }
}

void lists_of_blocks(Cloud *cloud)
{
    lists_of(cloud, 0, cloud->args.count, false);
}

void half_lists(Cloud *cloud)
{
    lists_of(cloud, 0, cloud->args.count, true);
}

/* The lists of the LANES particles from i on come to stand behind the `used` entries of their range. */
static void turn_group(Cloud *cloud, size_t i, size_t end, uint32_t *used)
{
    NeighbourLists *lists = &cloud->side_by_side;
    ListMemory *memory = &lists->of_range[i / LISTS_GRAIN];
    Found found = {.used = 0};
    uint32_t rows = 0;
    for (size_t k = 0; k < LANES && i + k < end; k++) {
        found.first[k] = cloud->first[i + k];
        found.count[k] = cloud->length[i + k];
        rows = found.count[k] > rows ? found.count[k] : rows;
    }
    if (!neighbour_lists_fit(lists, memory, *used + (size_t)(rows + LANES) * LANES))
        abort();
    interleave(cloud->index, &found, rows, (uint32_t)cloud->args.count, memory->index + *used);
    lists->first[i / LANES] = *used;
    lists->rows[i / LANES] = rows;
    *used += rows * LANES;
}

void turned_lists(Cloud *cloud)
{
    const size_t count = cloud->args.count;
    for (size_t begin = 0; begin < count; begin += LISTS_GRAIN) {
        const size_t end = begin + LISTS_GRAIN < count ? begin + LISTS_GRAIN : count;
        uint32_t used = 0;
        lists_of(cloud, begin, end, false);
        for (size_t i = begin; i < end; i += LANES)
            turn_group(cloud, i, end, &used);
    }
}
