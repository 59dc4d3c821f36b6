/* Makes the lists of neighbours. For each cell a block of all that its particles may see, then for each
   particle those of the block within h: both by compressing lanes to what a mask says. */
#include "sim/cpu/pair_loop.h"

enum { BLOCK_MOST = 1024 /* 20 kB */ };

/* Candidates: places and indices, filled up to whole LANES with PAST. */
typedef struct Block {
    int count;
    float x[BLOCK_MOST + LANES], y[BLOCK_MOST + LANES], z[BLOCK_MOST + LANES];
    int32_t j[BLOCK_MOST + LANES];
} Block;

#if defined(__AVX2__)
/* COMPRESS(m): a byte for each lane that is set in m, from the lowest on. */
#define SET(m, b)     ((m) >> (b)&1)
#define BELOW(m, b)   (__builtin_popcount((m) & ((1 << (b)) - 1)))
#define LANE(m, b)    ((uint64_t)(SET(m, b) ? (b) : 0) << 8 * BELOW(m, b))
#define COMPRESS(m)   (LANE(m, 1) | LANE(m, 2) | LANE(m, 3) | LANE(m, 4) | LANE(m, 5) | LANE(m, 6) | LANE(m, 7))
#define COMPRESS4(m)  COMPRESS(m), COMPRESS((m) + 1), COMPRESS((m) + 2), COMPRESS((m) + 3)
#define COMPRESS16(m) COMPRESS4(m), COMPRESS4((m) + 4), COMPRESS4((m) + 8), COMPRESS4((m) + 12)
#define COMPRESS64(m) COMPRESS16(m), COMPRESS16((m) + 16), COMPRESS16((m) + 32), COMPRESS16((m) + 48)
static const uint64_t compressed[256] = {COMPRESS64(0), COMPRESS64(64), COMPRESS64(128), COMPRESS64(192)};
#endif

/* Which lanes stay, and how many. */
typedef struct Kept {
    int bits, count;
#if defined(__AVX2__)
    __m256i lanes;
#endif
} Kept;

SIMD_INLINE Kept kept(i8 mask)
{
    Kept kept = {.bits = i8_bits(mask)};
    kept.count = __builtin_popcount((unsigned)kept.bits);
#if defined(__AVX2__)
    kept.lanes = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128((long long)compressed[kept.bits]));
#endif
    return kept;
}

/* Stores the lanes that stay, one behind the other, and something in the places up to LANES. */
SIMD_INLINE void keep(void *out, i8 from, Kept kept)
{
#if defined(__AVX2__)
    _mm256_storeu_si256(out, _mm256_permutevar8x32_epi32((__m256i)from, kept.lanes));
#else
    typedef int32_t __attribute__((may_alias)) Lane;
    Lane *to = out;
    for (int bits = kept.bits; bits; bits &= bits - 1)
        *to++ = from[__builtin_ctz((unsigned)bits)];
#endif
}

SIMD_INLINE f8 f8_abs(f8 a)
{
    return (f8)((i8)a & i8_splat(INT32_MAX));
}

SIMD_INLINE f8 away(const PairArgs *args, int axis, f8 d)
{
    (void)args, (void)axis;
#ifdef PAIRS_PERIODIC
    return shortest(d, args->fold[axis], args->fold_inverse[axis]);
#else
    return d;
#endif
}

/* The box around some particles: its middle and half of its size, m. */
typedef struct Around {
    f8 middle[3], half[3];
} Around;

SIMD_INLINE void around_axis(const float *x, size_t begin, size_t end, f8 *middle, f8 *half)
{
    float low = x[begin], high = low;
    for (size_t i = begin + 1; i < end; i++) {
        low = x[i] < low ? x[i] : low;
        high = x[i] > high ? x[i] : high;
    }
    *middle = f8_splat(0.5f * (low + high));
    *half = f8_splat(0.5f * (high - low));
}

SIMD_INLINE Around around(const PairArgs *args, size_t begin, size_t end)
{
    Around box;
    around_axis(args->x, begin, end, &box.middle[0], &box.half[0]);
    around_axis(args->y, begin, end, &box.middle[1], &box.half[1]);
    around_axis(args->z, begin, end, &box.middle[2], &box.half[2]);
    return box;
}

/* How far x is from the box along an axis; 0 within. */
SIMD_INLINE f8 outside(const PairArgs *args, const Around *box, int axis, f8 x)
{
    return f8_positive(f8_abs(away(args, axis, x - box->middle[axis])) - box->half[axis]);
}

/* Who is in the box or within h of it, of the particles [begin, end): a little more than h, since places in
   the box are rounded. Returns the new count. */
SIMD_INLINE int block_add(const PairArgs *args, const Around box, f8 reach2, uint32_t begin, uint32_t end,
                          int count, Block *block)
{
    const float *const px = args->x, *const py = args->y, *const pz = args->z;
    for (uint32_t j = begin; j < end; j += LANES) {
        const f8 x = f8_load(px + j), y = f8_load(py + j), z = f8_load(pz + j);
        const f8 dx = outside(args, &box, 0, x), dy = outside(args, &box, 1, y),
                 dz = outside(args, &box, 2, z);
        const i8 there = lane_index < i8_splat((int32_t)(end - j));
        const Kept seen = kept((dx * dx + dy * dy + dz * dz < reach2) & there);
        keep(block->x + count, (i8)x, seen);
        keep(block->y + count, (i8)y, seen);
        keep(block->z + count, (i8)z, seen);
        keep(block->j + count, lane_index + i8_splat((int32_t)j), seen);
        count += seen.count;
    }
    return count;
}

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
    const float h = args->constants->support_radius;
    const f8 reach2 = f8_splat(h * h * 1.0001f), past = f8_splat(PAST);
    const Around box = around(args, begin, end);
    int count = 0;
    for (int row = 0; row < rows->count; row++) {
        if (count + (int)(rows->end[row] - rows->begin[row]) > BLOCK_MOST)
            return false;
        count = block_add(args, box, reach2, rows->begin[row], rows->end[row], count, block);
    }
    f8_store(block->x + count, past);
    f8_store(block->y + count, past);
    f8_store(block->z + count, past);
    block->count = count;
    return true;
}

/* What is looked for around particle i. */
typedef struct Search {
    Place at;
    f8 h2, least2;
    i8 self;
} Search;

SIMD_INLINE Search search_of(const PairArgs *args, size_t i)
{
    const float h = args->constants->support_radius, least = 1e-6f * h;
    return (Search){place_of(args, i), f8_splat(h * h), f8_splat(least * least), i8_splat((int32_t)i)};
}

/* The list that is being written. */
typedef struct Writer {
    int32_t *at;
    i8 coincident; /* counted down by lanes; the particle itself is one */
} Writer;

/* Lanes that are no particle's are PAST. */
SIMD_INLINE Writer offer(const PairArgs *args, const Search search, f8 x, f8 y, f8 z, i8 j, Writer out)
{
    const f8 dx = away(args, 0, search.at.x - x), dy = away(args, 1, search.at.y - y),
             dz = away(args, 2, search.at.z - z);
    f8 r2 = dx * dx + dy * dy + dz * dz;
#ifdef PAIRS_PERIODIC
    r2 = f8_select(x < f8_splat(PAST), r2, f8_splat(PAST));
#endif
    const Kept seen = kept((r2 < search.h2) & (j != search.self));
    keep(out.at, j, seen);
    return (Writer){out.at + seen.count, out.coincident + (r2 < search.least2)};
}

SIMD_INLINE Writer list_block(const PairArgs *args, size_t i, const Block *block, Writer out)
{
    const Search search = search_of(args, i);
    const int count = block->count;
    for (int k = 0; k < count; k += LANES)
        out = offer(args, search, f8_load(block->x + k), f8_load(block->y + k), f8_load(block->z + k),
                    i8_load(block->j + k), out);
    return out;
}

/* Of a crowd that no block holds. */
static Writer list_rows(const PairArgs *args, size_t i, const Rows *rows, Writer out)
{
    const Search search = search_of(args, i);
    for (int row = 0; row < rows->count; row++)
        for (uint32_t j = rows->begin[row]; j < rows->end[row]; j += LANES) {
            const i8 there = lane_index < i8_splat((int32_t)(rows->end[row] - j));
            out = offer(args, search, f8_select(there, f8_load(args->x + j), f8_splat(PAST)),
                        f8_load(args->y + j), f8_load(args->z + j), lane_index + i8_splat((int32_t)j), out);
        }
    return out;
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
    out = block ? list_block(args, i, block, out) : list_rows(args, i, rows, out);
    const uint32_t count = (uint32_t)(out.at - first);
    i8_store(out.at, i8_splat((int32_t)args->count));
    lists->count[i] = count | (i8_sum(out.coincident) < -1 ? LISTS_COINCIDENT : 0);
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
