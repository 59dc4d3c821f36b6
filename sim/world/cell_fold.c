#include "sim/world/cell_fold.h"

enum {
    PLACES = 4,     /* per particle, at least: a cell of fluid has some nine particles */
    WORTH_IT = 2,   /* least ratio of cells to places */
    LEAST_BITS = 6, /* 27 adjacent cells need 64 places to be apart */
    DIFFERENCES = 9 /* per axis */
};

CellFold cell_fold_plain(const CellGrid *cells)
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
