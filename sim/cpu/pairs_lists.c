/* Builds the neighbour lists. Per cell, a block of all candidates; then per particle the candidates within
   h. */
#if defined(__AVX2__)
#include "sim/cpu/lists_avx2.h"
#else
#include "sim/cpu/lists_plain.h"
#endif

/* Nine rows of three cells, each of particles or of copies. */
typedef struct CellRowRanges {
    int count;
    uint32_t begin[27], end[27];
} CellRowRanges;

static void rows_add(CellRowRanges *rows, uint32_t begin, uint32_t end)
{
    if (begin == end)
        return;
    if (rows->count > 0 && rows->end[rows->count - 1] == begin) {
        rows->end[rows->count - 1] = end;
        return;
    }
    rows->begin[rows->count] = begin;
    rows->end[rows->count++] = end;
}

/* All particles in `cell` and the cells around, with copies across periodic sides. */
static void rows_of(const PairArgs *args, uint32_t cell, CellRowRanges *rows)
{
    const Constants *s = args->constants;
    const uint32_t width = (uint32_t)s->cells.size[0], height = (uint32_t)s->cells.size[1];
    const uint32_t x = cell % width, y = cell / width % height, z = cell / width / height;
    const uint32_t *start = args->cell_start, *copies = args->copy_start, count = (uint32_t)args->count;
    rows->count = 0;
    for (int row = s->first_row; row < s->last_row; row++) {
        const uint32_t first =
            cell_fold_at(args->fold, x - 1, y + (uint32_t)(row % 3) - 1, z + (uint32_t)(row / 3) - 1);
        if (!copies)
            rows_add(rows, start[first], start[first + 3]);
        for (uint32_t at = first; copies && at < first + 3; at++) {
            rows_add(rows, start[at], start[at + 1]);
            rows_add(rows, count + copies[at], count + copies[at + 1]);
        }
    }
}

/* Closes a block for offer(). */
SIMD_INLINE void block_end(CandidateBlock *block)
{
    f8_store(block->x + block->count, f8_splat(INFINITY));
}

/* The block of particles [begin, end) of a cell. False if the crowd around overflows the block. */
static bool block_make(const PairArgs *args, const CellRowRanges *rows, size_t begin, size_t end,
                       CandidateBlock *block)
{
    BlockBounds box;
    block_bounds(args, begin, end, &box);
    block->count = 0;
    for (int row = 0; row < rows->count; row++) {
        uint32_t from = rows->begin[row];
        if (block->count + (int)(rows->end[row] - from) > BLOCK_MOST)
            return false;
        if (from <= begin && begin < rows->end[row]) {
            block_add(args, &box, from, (uint32_t)begin, block);
            block->own = block->count;
            from = (uint32_t)begin;
        }
        block_add(args, &box, from, rows->end[row], block);
    }
    block_end(block);
    return true;
}

/* Lists the particle at entry `own` of a block; meanwhile the particle is at infinity. */
static void list_block(const PairArgs *args, size_t own, CandidateBlock *block, ListWriter *out)
{
    const float at[3] = {block->x[own], block->y[own], block->z[own]};
    block->x[own] = INFINITY;
    offer(args, at, block, out);
    block->x[own] = at[0];
}

/* For a crowd too large for a block: the candidates by blocks. */
static void list_rows(const PairArgs *args, size_t i, const CellRowRanges *rows, ListWriter *out)
{
    CandidateBlock block;
    const float at[3] = {args->x[i], args->y[i], args->z[i]};
    for (int row = 0; row < rows->count; row++)
        for (uint32_t j = rows->begin[row]; j < rows->end[row]; j += (uint32_t)block.count) {
            const uint32_t left = rows->end[row] - j;
            block.count = (int)(left < BLOCK_MOST ? left : BLOCK_MOST);
            for (int k = 0; k < block.count; k++) {
                const uint32_t from = j + (uint32_t)k;
                block.x[k] = from == i ? INFINITY : args->x[from];
                block.y[k] = args->y[from];
                block.z[k] = args->z[from];
                block.j[k] = (int32_t)list_entry(from);
            }
            block_end(&block);
            offer(args, at, &block, out);
        }
}

/* Upper bound of the number of candidates. */
static size_t most_of(const CellRowRanges *rows)
{
    size_t most = 0;
    for (int row = 0; row < rows->count; row++)
        most += rows->end[row] - rows->begin[row];
    return most;
}

/* Lists particle i, entry `own` of a block, after the group's lists so far. The list stays empty if memory is
   short. */
static void list_one(const PairArgs *args, size_t i, const CellRowRanges *rows, CandidateBlock *block,
                     size_t own, FoundNeighbours *found)
{
    NeighbourLists *lists = args->lists;
    ListMemory *memory = &lists->found[i / LISTS_GRAIN];
    const size_t lane = i % LANES, most = (block ? (size_t)block->count : most_of(rows)) + 2 * LANES;
    if (found->used + most > memory->capacity && !neighbour_lists_fit(lists, memory, found->used + most))
        return;
    int32_t *const first = (int32_t *)memory->index + found->used;
    ListWriter out = {.at = first};
    if (block)
        list_block(args, own, block, &out);
    else
        list_rows(args, i, rows, &out);
    i8_store(out.at, i8_splat((int32_t)list_entry(args->none)));
    const uint32_t count = (uint32_t)(out.at - first);
    found->first[lane] = found->used;
    found->count[lane] = count;
    found->coincident |= out.coincident;
    found->used += (count + LANES - 1) / LANES * LANES;
}

/* Interleaves the lists of particle i's group after the `used` entries of the range. */
static void list_group(const PairArgs *args, size_t i, const FoundNeighbours *found, uint32_t *used)
{
    NeighbourLists *lists = args->lists;
    ListMemory *memory = &lists->of_range[i / LISTS_GRAIN];
    uint32_t rows = 0;
    for (int lane = 0; lane < LANES; lane++)
        rows = found->count[lane] > rows ? found->count[lane] : rows;
    const uint32_t capacity = (rows + LANES - 1) / LANES * LANES * LANES;
    lists->first[i / LANES] = *used;
    lists->rows[i / LANES] = 0;
    if (rows == 0 || !neighbour_lists_fit(lists, memory, (size_t)*used + capacity))
        return;
    interleave(lists->found[i / LISTS_GRAIN].index, found, rows, list_entry(args->none),
               memory->index + *used);
    lists->rows[i / LANES] =
        rows | (found->coincident ? LISTS_COINCIDENT : 0) | (found->solid ? LISTS_SOLID : 0);
    *used += rows * LANES;
}

typedef struct ListBuild {
    FoundNeighbours found;
    uint32_t used; /* entries of the range's memory */
} ListBuild;

/* True for particles set aside, which have no neighbours, and for ghosts, which their owners list. */
static bool has_no_lists(const PairArgs *args, uint32_t cell)
{
    return cell == args->constants->cells.count || (args->foreign && args->foreign[cell]);
}

/* True if a boundary particle is in the rows; across periodic sides not looked for. */
static bool rows_have_solids(const PairArgs *args, const CellRowRanges *rows)
{
    bool found = args->copy_start != NULL;
    for (int row = 0; row < rows->count && !found; row++)
        for (uint32_t j = rows->begin[row]; j < rows->end[row] && !found; j++)
            found = args->fluid[j] >= FLUIDS_MAX;
    return found;
}

/* Lists the particles [begin, end), a cell or part of a cell. Boundary particles and ghosts have no lists. */
static void list_cell(const PairArgs *args, size_t begin, size_t end, bool last, ListBuild *making)
{
    const uint32_t cell = args->cell[begin];
    const bool aside = has_no_lists(args, cell);
    CellRowRanges rows = {.count = 0};
    CandidateBlock block;
    if (!aside)
        rows_of(args, cell, &rows);
    const bool solid = args->constants->solid_count > 0 && rows_have_solids(args, &rows);
    const bool fits = block_make(args, &rows, begin, end, &block);
    for (size_t i = begin; i < end; i++) {
        making->found.solid |= solid;
        if (!aside && args->fluid[i] < FLUIDS_MAX)
            list_one(args, i, &rows, fits ? &block : NULL, (size_t)block.own + i - begin, &making->found);
        if ((last && i + 1 == end) || (i + 1) % LANES == 0) {
            list_group(args, i, &making->found, &making->used);
            making->found = (FoundNeighbours){.used = 0};
        }
    }
}

/* Lists the particles of a range, from the range's first particle on. */
PAIR_LOOP(lists)
{
    ListBuild making = {.used = 0};
    for (size_t i = begin, stop; i < end; i = stop) {
        for (stop = i + 1; stop < end && args->cell[stop] == args->cell[i];)
            stop++;
        list_cell(args, i, stop, stop == end, &making);
    }
}
