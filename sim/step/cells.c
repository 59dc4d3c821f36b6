#include "sim/step/backend.h"

#include <math.h>

/* The cell at `place` along an axis; a place outside of the box is wrapped across a periodic side. */
static int across(const Constants *s, int k, int place, float *shift)
{
    const int cells = s->cells.size[k] - 2;
    *shift = 0;
    if (!s->periodic.axis[k] || (place > 0 && place <= cells))
        return place;
    *shift = place < 1 ? s->periodic.size[k] : -s->periodic.size[k];
    return place < 1 ? place + cells : place - cells;
}

/* `count` cells along x from `first` on. */
static CellRow row_from(const CellFold *fold, const uint32_t *start, int first, int count, const int at[3],
                        const float shift[3])
{
    const size_t place = cell_fold_at(fold, (uint32_t)first, (uint32_t)at[1], (uint32_t)at[2]);
    return (CellRow){
        .begin = start[place], .end = start[place + (size_t)count], .shift = {shift[0], shift[1], shift[2]}};
}

int cell_rows(const Constants *s, const CellFold *fold, const uint32_t *start, uint32_t cell,
              CellRow rows[CELL_ROWS])
{
    const int *size = s->cells.size, x = (int)(cell % (uint32_t)size[0]);
    const int y = (int)(cell / (uint32_t)size[0]) % size[1], z = (int)(cell / (uint32_t)size[0]) / size[1];
    const bool low = s->periodic.axis[0] && x == 1, high = s->periodic.axis[0] && x == size[0] - 2;
    int count = 0;
    for (int row = s->first_row; row < s->last_row; row++) {
        float shift[3] = {0};
        const int at[3] = {x, across(s, 1, y + row % 3 - 1, &shift[1]),
                           across(s, 2, z + row / 3 - 1, &shift[2])};
        rows[count++] = row_from(fold, start, low ? x : x - 1, low || high ? 2 : 3, at, shift);
        if (low || high) {
            const int far = across(s, 0, low ? x - 1 : x + 1, &shift[0]);
            rows[count++] = row_from(fold, start, far, 1, at, shift);
        }
    }
    return count;
}

uint32_t cell_near(const Constants *s, const CellFold *fold, size_t place, const float x[3])
{
    const CellGrid *cells = &s->cells;
    int at[3], middle = 13; /* of the 27 */
    for (int k = 0; k < 3; k++) {
        const float along = floorf((x[k] - cells->origin[k]) * cells->inverse[k]) - (float)cells->first[k];
        at[k] = (int)fminf(fmaxf(along, 1), (float)cells->size[k] - 2);
    }
    uint32_t cell = 0;
    for (int n = 0; n <= 27; n++) { /* if no cell fits, ends at the cell of x */
        const int near = n < 27 ? n : middle, step[3] = {near % 3 - 1, near / 3 % 3 - 1, near / 9 - 1};
        uint32_t to[3];
        float shift;
        for (int k = 0; k < 3; k++)
            to[k] = (uint32_t)across(s, k, at[k] + step[k], &shift);
        cell = (to[2] * (uint32_t)cells->size[1] + to[1]) * (uint32_t)cells->size[0] + to[0];
        if (cell_fold_at(fold, to[0], to[1], to[2]) == place)
            return cell;
    }
    return cell;
}

bool cell_row_repeats(const Constants *s, const CellRow *row)
{
    for (int k = 0; k < 3; k++)
        if (row->shift[k] != 0 && s->cells.size[k] - 2 == 2)
            return true;
    return false;
}

enum {
    PLACES = 4,     /* per particle, at least: a cell of fluid has some nine particles */
    WORTH_IT = 2,   /* least ratio of cells to places */
    LEAST_BITS = 6, /* 27 adjacent cells need 64 places to be apart */
    DIFFERENCES = 9 /* per axis */
};

/* A place per cell, no sharing. */
static CellFold cell_fold_plain(const CellGrid *cells)
{
    const uint32_t width = (uint32_t)cells->size[0];
    return (CellFold){
        .y = width, .z = width * (uint32_t)cells->size[1], .mask = UINT32_MAX, .count = cells->count};
}

/* Possible index differences along an axis between cells of a walk, also across a periodic side. */
static int differences(const Constants *s, int k, int out[DIFFERENCES])
{
    const int n = s->cells.size[k] - 2, all[DIFFERENCES] = {0, 1, -1, 2, -2, n - 1, 1 - n, n - 2, 2 - n};
    const int count = s->periodic.axis[k] ? DIFFERENCES : 5;
    for (int i = 0; i < count; i++)
        out[i] = all[i];
    return count;
}

static bool are_apart(const Constants *s, const CellFold *fold)
{
    int dx[DIFFERENCES], dy[DIFFERENCES], dz[DIFFERENCES];
    const int nx = differences(s, 0, dx), ny = differences(s, 1, dy), nz = differences(s, 2, dz);
    for (int i = 0; i < nx; i++)
        for (int j = 0; j < ny; j++)
            for (int k = 0; k < nz; k++) {
                const uint32_t at = fold->y * (uint32_t)dy[j] + fold->z * (uint32_t)dz[k] + (uint32_t)dx[i];
                if ((dx[i] || dy[j] || dz[k]) && (at & fold->mask) == 0)
                    return false;
            }
    return true;
}

/* Rows begin at points of the R2 sequence, 1/p and 1/p^2 of the table with p^3 = p + 1: evenly spread for
   any number of rows. False if no nearby offset keeps neighbour cells apart. */
static bool rows_spread(const Constants *s, CellFold *fold, uint32_t places)
{
    fold->mask = places - 1;
    fold->count = (size_t)places + (size_t)s->cells.size[0];
    for (uint32_t aside = 0; aside < 32; aside++) {
        fold->y = ((uint32_t)(0.7548776662466927 * places) + 2 * (aside % 8)) | 1;
        fold->z = ((uint32_t)(0.5698402909980532 * places) + 2 * (aside / 8)) | 1;
        if (are_apart(s, fold))
            return true;
    }
    return false;
}

CellFold cell_fold(const Constants *s, size_t particles)
{
    CellFold fold = {.shared = true};
    uint32_t places = 1U << LEAST_BITS;
    while (places < (size_t)PLACES * particles && places < 1U << 30)
        places *= 2;
    for (; WORTH_IT * ((size_t)places + (size_t)s->cells.size[0]) < s->cells.count; places *= 2)
        if (rows_spread(s, &fold, places))
            return fold;
    return cell_fold_plain(&s->cells);
}

static CoarseShape shape_of(const Constants *constants, int wide)
{
    CoarseShape shape = {.wide = wide, .cells = 1, .nodes = 1};
    for (int k = 0; k < 3; k++) {
        const int inner = constants->cells.size[k] > 2 ? constants->cells.size[k] - 2 : 1,
                  count = inner / wide > 1 ? inner / wide : 1;
        shape.inner[k] = inner;
        shape.count[k] = count;
        shape.along[k] = count + (constants->periodic.axis[k] || k >= constants->dimensions ? 0 : 1);
        shape.cells *= (size_t)count;
        shape.nodes *= (size_t)shape.along[k];
    }
    return shape;
}

CoarseShape coarse_shape(const Constants *constants, size_t most)
{
    CoarseShape shape;
    int wide = 1;
    do
        shape = shape_of(constants, wide *= 2);
    while (shape.cells > most);
    return shape;
}
