/* The walk over neighbours: the one that all pair loops have. For the files that are compiled once for each
   instruction set. */
#ifndef SLOSH_WALK_H
#define SLOSH_WALK_H

#include "sim/cpu/simd.h"

static const i8 lane_index = {0, 1, 2, 3, 4, 5, 6, 7};

/* The rows of cells next to one, cached while the cell stays the same: nine of three cells, more across
   periodic sides, where a particle at x is as one at x + shift. */
#ifdef PAIRS_PERIODIC
enum { ROWS_MOST = CELL_ROWS };
#define ROW_SHIFT(rows, row, axis, x) ((x) + f8_splat((rows).shift[axis][row]))
#else
enum { ROWS_MOST = 9 };
#define ROW_SHIFT(rows, row, axis, x) (x)
#endif

typedef struct Rows {
    uint32_t cell, begin[ROWS_MOST], end[ROWS_MOST];
    int first, last;
#ifdef PAIRS_PERIODIC
    float shift[3][ROWS_MOST]; /* m */
#endif
} Rows;

#define ROWS_NONE ((Rows){.cell = UINT32_MAX})

SIMD_INLINE void rows_of(const PairArgs *args, uint32_t cell, Rows *rows)
{
    if (rows->cell == cell)
        return;
    rows->cell = cell;
#ifdef PAIRS_PERIODIC
    CellRow row[CELL_ROWS];
    rows->first = 0;
    rows->last = cell_rows(args->constants, args->cell_start, cell, row);
    for (int k = 0; k < rows->last; k++) {
        rows->begin[k] = row[k].begin;
        rows->end[k] = row[k].end;
        for (int a = 0; a < 3; a++)
            rows->shift[a][k] = row[k].shift[a];
    }
#else
    rows->first = args->constants->first_row;
    rows->last = args->constants->last_row;
    for (int row = rows->first; row < rows->last; row++)
        pair_row(args, cell, row, &rows->begin[row], &rows->end[row]);
#endif
}

/* Where sums stand: in all lanes the same. */
typedef struct Place {
    f8 x, y, z;
} Place;

SIMD_INLINE Place place_at(const float x[3])
{
    return (Place){f8_splat(x[0]), f8_splat(x[1]), f8_splat(x[2])};
}

SIMD_INLINE Place place_of(const PairArgs *args, size_t i)
{
    return (Place){f8_splat(args->x[i]), f8_splat(args->y[i]), f8_splat(args->z[i])};
}

/* Where the particles of a row see it. */
SIMD_INLINE Place place_seen(const Rows *rows, int row, Place at)
{
    (void)rows, (void)row;
    return (Place){ROW_SHIFT(*rows, row, 0, at.x), ROW_SHIFT(*rows, row, 1, at.y),
                   ROW_SHIFT(*rows, row, 2, at.z)};
}

/* Eight who may be neighbours: x_ij = x_i - x_j, m; r^2. */
typedef struct Separation {
    f8 x, y, z, r2;
    i8 there; /* lanes that are particles of the row */
} Separation;

SIMD_INLINE Separation separation(const PairArgs *args, Place at, const Rows *rows, int row, uint32_t j)
{
    const Place from = place_seen(rows, row, at);
    Separation d = {.x = from.x - f8_load(args->x + j),
                    .y = from.y - f8_load(args->y + j),
                    .z = from.z - f8_load(args->z + j)};
    d.r2 = d.x * d.x + d.y * d.y + d.z * d.z;
    d.there = lane_index < i8_splat((int32_t)(rows->end[row] - j));
    return d;
}

/* Lanes from j on that are not particle i itself. */
SIMD_INLINE i8 others(size_t i, uint32_t j)
{
    return lane_index != i8_splat((int32_t)((uint32_t)i - j));
}

/* NEIGHBOURS (rows, row, j) { Separation d = separation(args, at, &rows, row, j); ... }: for each eight
   particles in the rows next to `at`, those from `j` on, `d` away. `continue` goes on to the next eight. */
#define NEIGHBOURS(rows, row, j)                                                                             \
    for (int row = (rows).first; row < (rows).last; row++)                                                   \
        for (uint32_t j = (rows).begin[row]; j < (rows).end[row]; j += LANES)

#endif
