#include "cloud.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const float support = 2.1F; /* h in spacings; the spacing is 1 m */

enum { LIST_ROOM = 96 }; /* entries a particle: with a skin of 0.2 h some 70 are in use */

/* Memory for `count` entries and some behind the last, all 0. */
static void *take(Cloud *cloud, size_t count, size_t size)
{
    const size_t bytes = ((count + 2 * LANES) * size + 63) / 64 * 64;
    void *piece = aligned_alloc(64, bytes);
    if (!piece)
        abort();
    cloud->piece[cloud->pieces++] = memset(piece, 0, bytes);
    return piece;
}

/* A number of [0, 1) that only `key` decides. */
static float chance(uint64_t key)
{
    key = (key + 1) * 0x9e3779b97f4a7c15U;
    key = (key ^ key >> 32) * 0xd6e8feb86659fd93U;
    return (float)(key >> 40) * 0x1p-24F;
}

/* Of particle `site` of the lattice: {x, y, z, p V^2, vx, vy, vz, V}. */
static void particle(size_t site, size_t side, float out[8])
{
    const size_t place[3] = {site % side, site / side % side, site / side / side};
    for (size_t k = 0; k < 8; k++)
        out[k] = k < 3 ? (float)place[k] + 0.4F * chance(8 * site + k) : 0.5F + chance(8 * site + k);
}

static int along(const Cloud *cloud, float x)
{
    return (int)(x / (cloud->shape.edge * support)) + cloud->across;
}

static uint32_t cell_of(const Cloud *cloud, const float x[3])
{
    uint32_t cell = 0;
    for (int k = 0; k < 3; k++)
        cell += cloud->axis[k][along(cloud, x[k])];
    return cell;
}

/* The bits of i, each with room for two more. */
static uint32_t spread(uint32_t i)
{
    uint32_t out = 0;
    for (int bit = 0; bit < 10; bit++)
        out |= (i >> bit & 1) << 3 * bit;
    return out;
}

static void number_cells(Cloud *cloud, size_t side)
{
    const Shape *shape = &cloud->shape;
    cloud->across = (int)ceilf(shape->reach / shape->edge);
    const int size = along(cloud, (float)side) + cloud->across + 1;
    uint32_t step = 1, last = 0;
    for (int k = 0; k < 3; k++, step *= (uint32_t)size) {
        cloud->constants.cells.size[k] = size;
        cloud->axis[k] = take(cloud, (size_t)size, sizeof **cloud->axis);
        for (uint32_t i = 0; i < (uint32_t)size; i++)
            cloud->axis[k][i] = shape->curve ? spread(i) << k : step * i;
        last += cloud->axis[k][size - 1];
    }
    cloud->constants.cells.count = last + 1;
}

static int compare(const void *left, const void *right)
{
    const uint64_t a = *(const uint64_t *)left, b = *(const uint64_t *)right;
    return (a > b) - (a < b);
}

/* In the order of cells: cell << 32 | site. */
static uint64_t *sorted(Cloud *cloud, size_t side)
{
    uint64_t *order = take(cloud, cloud->args.count, sizeof *order);
    float p[8];
    for (size_t site = 0; site < cloud->args.count; site++) {
        particle(site, side, p);
        order[site] = (uint64_t)cell_of(cloud, p) << 32 | site;
    }
    qsort(order, cloud->args.count, sizeof *order, compare);
    return order;
}

static void fill_cells(Cloud *cloud, const uint64_t *order)
{
    const size_t count = cloud->args.count, cells = cloud->constants.cells.count;
    uint32_t *start = take(cloud, cells + 1, sizeof *start), *cell = take(cloud, count, sizeof *cell);
    for (size_t i = 0; i < count; i++)
        start[(cell[i] = (uint32_t)(order[i] >> 32)) + 1]++;
    for (size_t k = 0; k < cells; k++)
        start[k + 1] += start[k];
    cloud->fold = cell_fold_plain(&cloud->constants.cells);
    cloud->args.fold = &cloud->fold;
    cloud->args.cell_start = start;
    cloud->args.cell = cell;
}

static void fill_columns(Cloud *cloud, const uint64_t *order, size_t side)
{
    PairArgs *a = &cloud->args;
    float *column[8], (*place)[4] = take(cloud, a->count, sizeof *place),
                      (*motion)[4] = take(cloud, a->count, sizeof *motion);
    for (int k = 0; k < 8; k++)
        column[k] = take(cloud, a->count, sizeof(float));
    for (size_t i = 0; i <= a->count; i++) {
        float p[8] = {PAST, PAST, PAST};
        if (i < a->count)
            particle((uint32_t)order[i], side, p);
        for (int k = 0; k < 8; k++)
            (k < 4 ? place : motion)[i][k % 4] = column[k][i] = p[k];
    }
    a->place = (const float(*)[4])place, a->motion = (const float(*)[4])motion;
    a->x = column[0], a->y = column[1], a->z = column[2], a->pressure_term = column[3];
    a->vx = column[4], a->vy = column[5], a->vz = column[6], a->volume = column[7];
}

static void fill_rest(Cloud *cloud)
{
    PairArgs *a = &cloud->args;
    float **const out[] = {&a->fx, &a->fy, &a->fz, &a->number_density};
    for (size_t k = 0; k < sizeof out / sizeof *out; k++)
        *out[k] = take(cloud, a->count, sizeof(float));
    a->id = take(cloud, a->count, sizeof *a->id);
    a->fluid = take(cloud, a->count, sizeof *a->fluid);
    cloud->first = take(cloud, a->count, sizeof *cloud->first);
    cloud->length = take(cloud, a->count, sizeof *cloud->length);
    cloud->index = take(cloud, LIST_ROOM * a->count, sizeof *cloud->index);
    cloud->sum = take(cloud, a->count, sizeof *cloud->sum);
    cloud->numbers = take(cloud, a->count, sizeof *cloud->numbers);
    for (size_t i = 0; i < a->count + LANES; i++)
        cloud->numbers[i] = (int32_t)i;
}

/* Kernels without their scales, one fluid of viscosity 1. */
static void fill_constants(Cloud *cloud)
{
    Constants *c = &cloud->constants;
    c->support_radius = support;
    c->kernel_scale = c->pressure_scale = c->viscosity_scale = c->viscosity[0] = 1;
    c->viscous = c->rubs = true;
    c->last_row = 9;
    c->dimensions = 3;
    cloud->wide = *c;
    cloud->wide.support_radius *= cloud->shape.reach;
    cloud->args.constants = c;
    cloud->args.lists = &cloud->side_by_side;
    cloud->making = cloud->args;
    cloud->making.constants = &cloud->wide;
}

Cloud *cloud_create(size_t side, const Shape *shape)
{
    Cloud *cloud = calloc(1, sizeof *cloud);
    if (!cloud || !neighbour_lists_create(&cloud->side_by_side, side * side * side, 40))
        abort();
    cloud->shape = *shape;
    cloud->args.count = side * side * side;
    cloud->args.none = (uint32_t)cloud->args.count;
    number_cells(cloud, side);
    const uint64_t *order = sorted(cloud, side);
    fill_cells(cloud, order);
    fill_columns(cloud, order, side);
    fill_rest(cloud);
    fill_constants(cloud);
    return cloud;
}

void cloud_destroy(Cloud *cloud)
{
    neighbour_lists_destroy(&cloud->side_by_side);
    for (int k = 0; k < cloud->pieces; k++)
        free(cloud->piece[k]);
    free(cloud);
}

/* One run more, or the last one longer. */
static int run_add(Run runs[RUNS], int count, uint32_t begin, uint32_t end)
{
    if (count > 0 && runs[count - 1].end == begin) {
        runs[count - 1].end = end;
        return count;
    }
    runs[count] = (Run){begin, end};
    return count + 1;
}

int cloud_runs(const Cloud *cloud, size_t i, Run runs[RUNS])
{
    const PairArgs *args = &cloud->args;
    const uint32_t *start = args->cell_start;
    const int across = cloud->across, together = cloud->shape.curve ? 1 : 2 * across + 1;
    const int x = along(cloud, args->x[i]), y = along(cloud, args->y[i]), z = along(cloud, args->z[i]);
    int count = 0;
    for (int c = z - across; c <= z + across; c++)
        for (int b = y - across; b <= y + across; b++)
            for (int a = x - across; a <= x + across; a += together) {
                const uint32_t row = cloud->axis[1][b] + cloud->axis[2][c];
                const uint32_t *from = &start[row + cloud->axis[0][a]];
                count = run_add(runs, count, from[0], from[together]);
            }
    return count;
}
