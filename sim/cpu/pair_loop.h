/* What the loops over pairs share. For the files that are compiled once for each instruction set. */
#ifndef SLOSH_PAIR_LOOP_H
#define SLOSH_PAIR_LOOP_H

#include "sim/cpu/simd.h"

#include <math.h>

/* A name of its own for each set, and the set's name as a string. */
#define PAIR_JOIN(name, set)   name##_##set
#define PAIR_EXPAND(name, set) PAIR_JOIN(name, set)
#define PAIR_NAME(name)        PAIR_EXPAND(name, SIMD_SET)
#define PAIR_STRING(set)       #set
#define PAIR_LABEL(set)        PAIR_STRING(set)
#define PAIR_SET               PAIR_LABEL(SIMD_SET)

void PAIR_NAME(tension)(const PairArgs *args, size_t begin, size_t end);
void PAIR_NAME(wcsph_slope)(const PairArgs *args, size_t begin, size_t end);
void PAIR_NAME(wcsph_rate)(const PairArgs *args, size_t begin, size_t end);
void PAIR_NAME(wcsph_force)(const PairArgs *args, size_t begin, size_t end);
void PAIR_NAME(images_rate)(const PairArgs *args, size_t begin, size_t end);
void PAIR_NAME(images_force)(const PairArgs *args, size_t begin, size_t end);

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

/* Where a row's particles see the one that sums stand: (xi, yi, zi), as (xr, yr, zr). */
#define ROW_ORIGIN                                                                                           \
    const f8 xr = ROW_SHIFT(rows, row, 0, xi), yr = ROW_SHIFT(rows, row, 1, yi),                             \
             zr = ROW_SHIFT(rows, row, 2, zi)

typedef struct Rows {
    uint32_t cell, begin[ROWS_MOST], end[ROWS_MOST];
    int first, last;
#ifdef PAIRS_PERIODIC
    float shift[3][ROWS_MOST]; /* m */
#endif
} Rows;

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

typedef struct Separation {
    f8 x, y, z, r2;
} Separation;

/* A direction that only the two ids decide, opposite for (a, b) and (b, a); of two dimensions in the plane.
 */
static void direction_of_ids(uint32_t a, uint32_t b, int dimensions, float out[3])
{
    const uint32_t low = a < b ? a : b, high = a < b ? b : a;
    uint32_t hash = low * 0x9e3779b1u ^ (high * 0x85ebca77u + 0x165667b1u);
    float length2 = 0;
    for (int k = 0; k < dimensions; k++) {
        hash = (hash ^ hash >> 15) * 0x2c1b3c6du;
        hash ^= hash >> 13;
        out[k] = (float)(hash >> 8) * 0x1p-23f - 1 + 0x1p-24f; /* never 0 */
        length2 += out[k] * out[k];
    }
    const float scale = (a < b ? 1.0f : -1.0f) / sqrtf(length2);
    for (int k = 0; k < dimensions; k++)
        out[k] *= scale;
}

/* Gives coincident pairs the length `least` and a direction by their ids (DESIGN 3). */
static __attribute__((noinline, unused)) void separate(const PairArgs *args, size_t i, uint32_t j, int bits,
                                                       float least, Separation *d)
{
    for (int k = 0; k < LANES; k++)
        if (bits >> k & 1) {
            float direction[3] = {0};
            direction_of_ids(args->id[i], args->id[j + (uint32_t)k], args->constants->dimensions, direction);
            d->x[k] = direction[0] * least;
            d->y[k] = direction[1] * least;
            d->z[k] = direction[2] * least;
            d->r2[k] = least * least;
        }
}

#endif
