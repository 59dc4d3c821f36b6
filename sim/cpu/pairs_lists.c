/* Makes the lists of neighbours. For each cell a block of all that its particles may see, then for each
   particle those of the block within h. */
#if defined(__AVX2__)
#include "sim/cpu/lists_avx2.h"
#else
#include "sim/cpu/lists_plain.h"
#endif

typedef struct Rows {
    int count;
    uint32_t begin[CELL_ROWS], end[CELL_ROWS];
} Rows;

#ifndef PAIRS_PERIODIC
/* The particles [begin, end) that stand in the three cells of one row next to `cell`; row 0..8. Not in a box
   with periodic sides. */
static inline void pair_row(const PairArgs *args, uint32_t cell, int row, uint32_t *begin, uint32_t *end)
{
    const int *size = args->constants->cells.size;
    const long middle = (long)cell + ((long)(row / 3 - 1) * size[1] + (row % 3 - 1)) * size[0];
    *begin = args->cell_start[middle - 1];
    *end = args->cell_start[middle + 2];
}
#endif

static void rows_of(const PairArgs *args, uint32_t cell, Rows *rows)
{
    const Constants *s = args->constants;
    rows->count = 0;
#ifdef PAIRS_PERIODIC
    CellRow row[CELL_ROWS];
    const int count = cell_rows(s, args->cell_start, cell, row);
    for (int k = 0; k < count; k++) {
        if (cell_row_again(s, &row[k]))
            continue;
        rows->begin[rows->count] = row[k].begin;
        rows->end[rows->count++] = row[k].end;
    }
#else
    for (int row = s->first_row; row < s->last_row; row++, rows->count++)
        pair_row(args, cell, row, &rows->begin[rows->count], &rows->end[rows->count]);
#endif
}

/* Of the particles [begin, end) of one cell. False when the block is too small for the crowd around them. */
static bool block_make(const PairArgs *args, const Rows *rows, size_t begin, size_t end, Block *block)
{
    Around box;
    around(args, begin, end, &box);
    block->count = 0;
    for (int row = 0; row < rows->count; row++) {
        if (block->count + (int)(rows->end[row] - rows->begin[row]) > BLOCK_MOST)
            return false;
        block_add(args, &box, rows->begin[row], rows->end[row], block);
    }
    return true;
}

static void list_block(const PairArgs *args, size_t i, const Block *block, Writer *out)
{
    offer(args, i, block->x, block->y, block->z, block->j, block->count, out);
}

/* Of a crowd that no block holds. */
static void list_rows(const PairArgs *args, size_t i, const Rows *rows, Writer *out)
{
    int32_t index[BLOCK_MOST + LANES];
    for (int row = 0; row < rows->count; row++)
        for (uint32_t j = rows->begin[row]; j < rows->end[row]; j += BLOCK_MOST) {
            const uint32_t left = rows->end[row] - j;
            const int count = (int)(left < BLOCK_MOST ? left : BLOCK_MOST);
            for (int k = 0; k < count; k++)
                index[k] = (int32_t)j + k;
            offer(args, i, args->x + j, args->y + j, args->z + j, index, count, out);
        }
}

/* As many as there are of them, rounded up. */
static size_t most_of(const Rows *rows)
{
    size_t most = 0;
    for (int row = 0; row < rows->count; row++)
        most += rows->end[row] - rows->begin[row];
    return most;
}

static void list_one(const PairArgs *args, size_t i, const Rows *rows, const Block *block, uint32_t *used)
{
    NeighbourLists *lists = args->lists;
    const size_t range = i / LISTS_GRAIN;
    lists->first[i] = *used;
    lists->count[i] = 0;
    if (!neighbour_lists_fit(lists, range,
                             *used + (block ? (size_t)block->count : most_of(rows)) + 2 * LANES))
        return;
    int32_t *const first = (int32_t *)lists->of_range[range].index + *used;
    Writer out = {.at = first};
    if (block)
        list_block(args, i, block, &out);
    else
        list_rows(args, i, rows, &out);
    const uint32_t count = (uint32_t)(out.at - first);
    i8_store(out.at, i8_splat((int32_t)args->count));
    lists->count[i] = count | (out.coincident > 1 ? LISTS_COINCIDENT : 0);
    *used += (count + LANES - 1) / LANES * LANES;
}

/* Those of one range, from its first particle on. */
PAIR_LOOP(lists)
{
    Block block;
    Rows rows;
    uint32_t used = 0;
    for (size_t i = begin, stop; i < end; i = stop) {
        const uint32_t cell = args->cell[i];
        if (cell == args->constants->cells.count) /* set aside, and all that follow */
            return;
        for (stop = i; stop < end && args->cell[stop] == cell;)
            stop++;
        rows_of(args, cell, &rows);
        const bool fits = block_make(args, &rows, i, stop, &block);
        for (size_t k = i; k < stop; k++)
            if (args->fluid[k] < FLUIDS_MAX)
                list_one(args, k, &rows, fits ? &block : NULL, &used);
    }
}
