/* The distance from a surface through points, by moving least squares. After: R. Kolluri, "Provably good
   moving least squares", 2005: near the points, f(x) = sum w_j n_j . (x - x_j) / sum w_j is the distance from
   the surface; here w is Wendland's C2 of |x - x_j| / h. Beyond h of all points the grid takes the side of
   the nearest value. */
#include "sim/points/scattered.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CELLS = 128, REACH = 3 }; /* cells along the longest side at most; h, cells */

typedef struct Fit {
    const ScatteredPoints *points;
    VolumeData *volume;
    float *value, *weight; /* sums of w n . (x - x_j), and of w */
    double cell, reach;    /* m */
} Fit;

static bool bounds_of(const ScatteredPoints *points, double low[3], double high[3], Error *error)
{
    for (size_t i = 0; i < points->count; i++)
        for (int k = 0; k < 3; k++) {
            const double at = (double)points->place[i][k];
            if (!isfinite(at) || !isfinite(points->normal[i][k]))
                return error_set(error, "point %zu has no finite place and normal", i);
            low[k] = i == 0 ? at : fmin(low[k], at);
            high[k] = i == 0 ? at : fmax(high[k], at);
        }
    return true;
}

/* How many of CELLS^3 cells have points: of a surface the square of the number along a side. */
static size_t count_cells(const ScatteredPoints *points, const double low[3], double cell,
                          unsigned char *seen)
{
    size_t count = 0;
    for (size_t i = 0; i < points->count; i++) {
        size_t number = 0;
        for (int k = 3; k-- > 0;) {
            const int at = (int)(((double)points->place[i][k] - low[k]) / cell);
            number = CELLS * number + (size_t)(at < CELLS ? at : CELLS - 1);
        }
        count += !seen[number];
        seen[number] = 1;
    }
    return count;
}

/* The mean distance between points: cells are enlarged until most have two points. NAN: no memory. */
static double distance_between(const ScatteredPoints *points, const double low[3], double longest)
{
    unsigned char *seen = malloc((size_t)CELLS * CELLS * CELLS);
    double cell = longest / CELLS;
    for (; seen && cell < longest; cell *= 1.25) {
        memset(seen, 0, (size_t)CELLS * CELLS * CELLS);
        if (2 * count_cells(points, low, cell, seen) <= points->count)
            break;
    }
    free(seen);
    return seen ? cell / sqrt(3) : NAN; /* a surface at a slant cuts half as many cells again */
}

static size_t number_of(const VolumeData *volume, int i, int j, int k)
{
    return (size_t)i + (size_t)volume->size[0] * ((size_t)j + (size_t)volume->size[1] * (size_t)k);
}

static void add_at(const Fit *fit, size_t point, const int index[3])
{
    const float *place = fit->points->place[point], *normal = fit->points->normal[point];
    double square = 0, along = 0, length = 0;
    for (int k = 0; k < 3; k++) {
        const double d = fit->volume->corner[k] + fit->cell * index[k] - (double)place[k],
                     n = (double)normal[k];
        square += d * d;
        along += n * d;
        length += n * n;
    }
    const double q = 1 - sqrt(square) / fit->reach;
    if (!(q > 0 && length > 0))
        return;
    const double w = q * q * q * q * (5 - 4 * q); /* (1 - r)^4 (4 r + 1) */
    const size_t number = number_of(fit->volume, index[0], index[1], index[2]);
    fit->value[number] += (float)(w * along / sqrt(length));
    fit->weight[number] += (float)w;
}

static void add_point(const Fit *fit, size_t point)
{
    int first[3], last[3], at[3];
    for (int k = 0; k < 3; k++) {
        const double middle = ((double)fit->points->place[point][k] - fit->volume->corner[k]) / fit->cell;
        first[k] = (int)fmax(ceil(middle - fit->reach / fit->cell), 0);
        last[k] = (int)fmin(floor(middle + fit->reach / fit->cell), fit->volume->size[k] - 1);
    }
    for (at[2] = first[2]; at[2] <= last[2]; at[2]++)
        for (at[1] = first[1]; at[1] <= last[1]; at[1]++)
            for (at[0] = first[0]; at[0] <= last[0]; at[0]++)
                add_at(fit, point, at);
}

/* 0.5 on the surface; the distance is full after h. */
static void finish_known(const Fit *fit, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (fit->weight[i] > 0) {
            const double away = (double)fit->value[i] / (double)fit->weight[i] / fit->reach;
            fit->value[i] = (float)fmin(fmax(0.5 - 0.5 * away, 0), 1);
        }
}

/* Gives a value without points the side of its neighbour in the queue. */
static void reach_out(const Fit *fit, size_t from, size_t to, uint32_t *queue, size_t *end)
{
    if (fit->weight[to] > 0)
        return;
    fit->weight[to] = 1;
    fit->value[to] = fit->value[from] < 0.5F ? 0 : 1;
    queue[(*end)++] = (uint32_t)to;
}

static void spread(const Fit *fit, size_t count, uint32_t *queue)
{
    const int *size = fit->volume->size;
    const size_t step[3] = {1, (size_t)size[0], (size_t)size[0] * (size_t)size[1]};
    size_t end = 0;
    for (size_t i = 0; i < count; i++)
        if (fit->weight[i] > 0)
            queue[end++] = (uint32_t)i;
    for (size_t begin = 0; begin < end; begin++) {
        const size_t from = queue[begin];
        for (int k = 0; k < 3; k++) {
            const size_t at = from / step[k] % (size_t)size[k];
            if (at > 0)
                reach_out(fit, from, from - step[k], queue, &end);
            if (at + 1 < (size_t)size[k])
                reach_out(fit, from, from + step[k], queue, &end);
        }
    }
}

/* The grid: two cells beyond where values differ. */
static void make_grid(const double low[3], const double high[3], double cell, VolumeData *volume)
{
    for (int k = 0; k < 3; k++) {
        volume->spacing[k] = cell;
        volume->corner[k] = low[k] - (REACH + 2) * cell;
        volume->size[k] = (int)ceil((high[k] - low[k]) / cell) + 2 * (REACH + 2) + 1;
    }
}

bool scattered_volume(const ScatteredPoints *points, VolumeData *volume, float **values, Error *error)
{
    double low[3] = {0}, high[3] = {0}, longest = 0;
    *values = NULL;
    if (!bounds_of(points, low, high, error))
        return false;
    for (int k = 0; k < 3; k++)
        longest = fmax(longest, high[k] - low[k]);
    if (points->count < 3 || !(longest > 0))
        return error_set(error, "%zu points make no surface; at least three at different places do",
                         points->count);
    const double cell = fmax(longest / CELLS, distance_between(points, low, longest));
    if (isnan(cell))
        return error_set(error, "no memory for %zu points", points->count);
    make_grid(low, high, cell, volume);
    const size_t count = (size_t)volume->size[0] * (size_t)volume->size[1] * (size_t)volume->size[2];
    Fit fit = {points, volume,      calloc(count, sizeof(float)), calloc(count, sizeof(float)),
               cell,   REACH * cell};
    uint32_t *queue = malloc(count * sizeof *queue);
    const bool made = fit.value && fit.weight && queue;
    for (size_t i = 0; made && i < points->count; i++)
        add_point(&fit, i);
    if (made) {
        finish_known(&fit, count);
        spread(&fit, count, queue);
    }
    free(queue);
    free(fit.weight);
    if (!made) {
        free(fit.value);
        return error_set(error, "no memory for %zu points", points->count);
    }
    volume->value = *values = fit.value;
    return true;
}
