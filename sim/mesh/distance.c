#include "sim/base/base.h"
#include "sim/mesh/mesh_shape.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    CELLS = 64, /* along the longest side */
    ACROSS = 3, /* least number of cells through a part of mean thickness */
    ROOM = 8,   /* cells of margin around the surface, plus a fraction of a cell */
    COARSE = 4, /* cells between neighbouring values of the coarse grid */
    NODES_MOST = 1 << 23
};

/* Shift of the grid, in cells: keeps grid lines off the planes of the model's own lattice. */
static const double aside[3] = {0.3819660113, 0.4142135624, 0.2679491924};

size_t distance_count(const DistanceGrid *grid)
{
    return (size_t)grid->size[0] * (size_t)grid->size[1] * (size_t)grid->size[2];
}

static size_t index_of(const DistanceGrid *grid, int i, int j, int k)
{
    return (size_t)i + (size_t)grid->size[0] * ((size_t)j + (size_t)grid->size[1] * (size_t)k);
}

/* ---- shape of the grid ---- */

static double nodes_of(DistanceGrid *grid, double cell)
{
    double nodes = 1;
    for (int k = 0; k < 3; k++) {
        const int cells = (int)ceil(2 * grid->inner[k] / cell) + 2 * ROOM + 1;
        grid->size[k] = (cells + COARSE - 1) / COARSE * COARSE + 1;
        grid->low[k] = -grid->inner[k] - (ROOM + aside[k]) * cell;
        nodes *= grid->size[k];
    }
    grid->cell = cell;
    return nodes;
}

static void shape(DistanceGrid *grid, const Triangles *of)
{
    double low[3];
    triangles_bounds(of, low, grid->inner);
    const double longest = 2 * fmax(fmax(grid->inner[0], grid->inner[1]), grid->inner[2]);
    const double thick = 2 * triangles_volume(of) / triangles_area(of); /* of an equivalent plate */
    double cell = longest / CELLS;
    if (thick > 0)
        cell = fmax(fmin(cell, thick / ACROSS), longest / (16 * CELLS));
    while (nodes_of(grid, cell) > NODES_MOST)
        cell *= 1.1;
}

/* ---- distances without a sign ---- */

typedef struct DistanceJob {
    DistanceGrid *grid;
    const TriangleTree *tree;
    const Stop *stop;
    int32_t *winding; /* change on the way to each node from the node before */
} DistanceJob;

static void place_of(const DistanceGrid *grid, int i, int j, int k, double x[3])
{
    const int at[3] = {i, j, k};
    for (int a = 0; a < 3; a++)
        x[a] = grid->low[a] + at[a] * grid->cell;
}

static float exact_at(const DistanceJob *work, int i, int j, int k, uint32_t *near)
{
    double x[3];
    place_of(work->grid, i, j, k, x);
    return (float)triangle_tree_nearest(work->tree, x, near);
}

/* Distance at a corner: exact up to ROOM cells, else up to 2 % too large. */
static float nearly_at(const DistanceJob *work, int i, int j, int k, uint32_t *near)
{
    const double exact = ROOM * work->grid->cell;
    double x[3];
    place_of(work->grid, i, j, k, x);
    const double d = triangle_tree_near(work->tree, x, 0.02, near);
    return (float)(d < exact ? triangle_tree_nearest(work->tree, x, near) : d);
}

static void coarse_range(void *context, size_t begin, size_t end)
{
    const DistanceJob *work = context;
    DistanceGrid *grid = work->grid;
    for (size_t row = begin; row < end; row++) {
        const int rows = (grid->size[1] - 1) / COARSE + 1;
        const int j = (int)row % rows * COARSE, k = (int)row / rows * COARSE;
        uint32_t near = 0;
        for (int i = 0; i < grid->size[0] && !stop_wanted(work->stop); i += COARSE)
            grid->value[index_of(grid, i, j, k)] = nearly_at(work, i, j, k, &near);
    }
}

/* A block between eight values of the coarse grid. Corners at the far end of each axis belong to the next
   block. */
typedef struct GridBlock {
    int low[3];
    double corner[8]; /* distances */
} GridBlock;

static void block_at(const DistanceGrid *grid, int i, int j, int k, GridBlock *block)
{
    block->low[0] = i, block->low[1] = j, block->low[2] = k;
    for (int c = 0; c < 8; c++)
        block->corner[c] = grid->value[index_of(grid, i + (c & 1) * COARSE, j + (c >> 1 & 1) * COARSE,
                                                k + (c >> 2) * COARSE)];
}

static double between(const double corner[8], const double t[3])
{
    double sum = 0;
    for (int c = 0; c < 8; c++)
        sum += corner[c] * (c & 1 ? t[0] : 1 - t[0]) * (c & 2 ? t[1] : 1 - t[1]) * (c & 4 ? t[2] : 1 - t[2]);
    return sum;
}

/* True if the whole block is farther than 2.5 cells from the surface. */
static bool is_far(const DistanceJob *work, const GridBlock *block, uint32_t *near)
{
    const int half = COARSE / 2, *low = block->low;
    const double corner = sqrt(3) * half, margin = 2.5;
    return nearly_at(work, low[0] + half, low[1] + half, low[2] + half, near) >
           (corner + margin) * work->grid->cell;
}

static void fill_block(const DistanceJob *work, const GridBlock *block, uint32_t *near)
{
    DistanceGrid *grid = work->grid;
    const bool far = is_far(work, block, near);
    for (int k = 0; k < COARSE; k++)
        for (int j = 0; j < COARSE; j++)
            for (int i = 0; i < COARSE; i++) {
                const int at[3] = {block->low[0] + i, block->low[1] + j, block->low[2] + k};
                float *value = &grid->value[index_of(grid, at[0], at[1], at[2])];
                if (i + j + k == 0)
                    continue;
                *value =
                    far ? (float)between(block->corner, (double[]){(double)i / COARSE, (double)j / COARSE,
                                                                   (double)k / COARSE})
                        : exact_at(work, at[0], at[1], at[2], near);
            }
}

/* Fills layers of blocks. The coarse values on a layer's far side belong to the next layer and are only
   read. */
static void fine_range(void *context, size_t begin, size_t end)
{
    const DistanceJob *work = context;
    const DistanceGrid *grid = work->grid;
    GridBlock block;
    uint32_t near = 0;
    for (size_t layer = begin; layer < end; layer++)
        for (int j = 0; j + 1 < grid->size[1]; j += COARSE)
            for (int i = 0; i + 1 < grid->size[0] && !stop_wanted(work->stop); i += COARSE) {
                block_at(grid, i, j, (int)layer * COARSE, &block);
                fill_block(work, &block, &near);
            }
}

/* ---- the sign ---- */

static const double MARGIN = 1e-6; /* cells: more than the rounding error of a crossing */

/* Nodes along an axis from `low` to `high`, m. */
static void nodes_between(const DistanceGrid *grid, int axis, double low, double high, int *begin, int *end)
{
    *begin = (int)fmax(0, ceil((low - grid->low[axis]) / grid->cell - MARGIN));
    *end = (int)fmin(grid->size[axis], floor((high - grid->low[axis]) / grid->cell + MARGIN) + 1);
}

/* Records winding changes where the grid lines of layer k cross triangle t. Whole numbers: their sum is the
   same in any order. */
static void cross_layer(const DistanceJob *work, size_t t, int k)
{
    const DistanceGrid *grid = work->grid;
    double low, high;
    int begin, end;
    triangle_slice(work->tree->of, t, grid->low[2] + k * grid->cell, MARGIN * grid->cell, &low, &high);
    if (low > high)
        return;
    nodes_between(grid, 1, low, high, &begin, &end);
    for (int j = begin; j < end; j++) {
        double p[3], x = 0;
        place_of(grid, 0, j, k, p);
        const int way = triangle_crossing(work->tree->of, t, p, &x);
        const double at = floor((x - grid->low[0]) / grid->cell) + 1;
        if (way != 0 && at >= 0 && at < grid->size[0])
            __atomic_fetch_sub(&work->winding[index_of(grid, (int)at, j, k)], way, __ATOMIC_RELAXED);
    }
}

static void cross_range(void *context, size_t first, size_t last)
{
    const DistanceJob *work = context;
    const Triangles *of = work->tree->of;
    for (size_t t = first; t < last && !stop_wanted(work->stop); t++) {
        double low = INFINITY, high = -INFINITY;
        int begin, end;
        for (int c = 0; c < 3; c++) {
            low = fmin(low, of->vertex[of->triangle[t][c]][2]);
            high = fmax(high, of->vertex[of->triangle[t][c]][2]);
        }
        nodes_between(work->grid, 2, low, high, &begin, &end);
        for (int k = begin; k < end; k++)
            cross_layer(work, t, k);
    }
}

static void sign_range(void *context, size_t begin, size_t end)
{
    const DistanceJob *work = context;
    const DistanceGrid *grid = work->grid;
    bool overlaps = false;
    for (size_t k = begin; k < end; k++)
        for (int j = 0; j < grid->size[1]; j++)
            for (int i = 0, winding = 0; i < grid->size[0]; i++) {
                const size_t at = index_of(grid, i, j, (int)k);
                winding += work->winding[at];
                if (winding != 0)
                    grid->value[at] = -grid->value[at];
                overlaps |= winding < 0 || winding > 1;
            }
    if (!overlaps)
        return;
    parallel_lock();
    work->grid->overlaps = true;
    parallel_unlock();
}

/* ---- within parts that overlap ---- */

/* Depth of a node from the depths of three neighbours, least first, by |grad d| = 1: Zhao, "A fast sweeping
   method for Eikonal equations", 2005, (2.4). */
static double by_neighbours(const double a[3], double cell)
{
    double d = a[0] + cell;
    if (d <= a[1])
        return d;
    d = 0.5 * (a[0] + a[1] + sqrt(2 * cell * cell - (a[0] - a[1]) * (a[0] - a[1])));
    if (d <= a[2])
        return d;
    const double sum = a[0] + a[1] + a[2], squares = a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
    return (sum + sqrt(fmax(0, sum * sum - 3 * (squares - cell * cell)))) / 3;
}

static void order(double *low, double *high)
{
    const double l = fmin(*low, *high), h = fmax(*low, *high);
    *low = l, *high = h;
}

/* Updates the depth of an inner node. Nodes outside have depth 0. The end planes of the grid are outside. */
static void deepen(const DistanceGrid *grid, float *deep, const int at[3])
{
    const size_t step[3] = {1, (size_t)grid->size[0], (size_t)grid->size[0] * (size_t)grid->size[1]},
                 here = index_of(grid, at[0], at[1], at[2]);
    double a[3];
    for (int k = 0; k < 3; k++)
        a[k] = fminf(deep[here - step[k]], deep[here + step[k]]);
    order(&a[0], &a[1]);
    order(&a[1], &a[2]);
    order(&a[0], &a[1]);
    deep[here] = fminf(deep[here], (float)by_neighbours(a, grid->cell));
}

/* Sweeps all inner nodes; bits 1, 2, 4 of `way` reverse x, y, z. */
static void sweep(const DistanceGrid *grid, float *deep, int way)
{
    const int *size = grid->size;
    for (int k = 1; k < size[2] - 1; k++)
        for (int j = 1; j < size[1] - 1; j++)
            for (int i = 1; i < size[0] - 1; i++) {
                const int at[3] = {way & 1 ? size[0] - 1 - i : i, way & 2 ? size[1] - 1 - j : j,
                                   way & 4 ? size[2] - 1 - k : k};
                if (grid->value[index_of(grid, at[0], at[1], at[2])] < 0)
                    deepen(grid, deep, at);
            }
}

/* Surfaces of parts within other parts do not count: where such a surface was nearest, depths are computed
   again, starting at nodes next to the surface of the union. Returns false if memory is short. */
static bool leave_inner_surfaces(DistanceGrid *grid)
{
    const size_t count = distance_count(grid);
    float *deep = calloc(count + 1, sizeof *deep);
    if (!deep)
        return false;
    const size_t step[3] = {1, (size_t)grid->size[0], (size_t)grid->size[0] * (size_t)grid->size[1]};
    for (size_t i = 0; i < count; i++) {
        bool border = false;
        for (int k = 0; k < 3 && grid->value[i] < 0; k++)
            border |= grid->value[i - step[k]] >= 0 || grid->value[i + step[k]] >= 0;
        deep[i] = grid->value[i] >= 0 ? 0 : border ? -grid->value[i] : INFINITY;
    }
    for (int way = 0; way < 16; way++)
        sweep(grid, deep, way & 7);
    for (size_t i = 0; i < count; i++)
        if (grid->value[i] < 0 && deep[i] > 0.5F * (float)grid->cell - grid->value[i])
            grid->value[i] = -deep[i];
    free(deep);
    return true;
}

bool distance_make(DistanceGrid *grid, const TriangleTree *tree, int threads, const Stop *stop)
{
    *grid = (DistanceGrid){0};
    shape(grid, tree->of);
    const size_t layers = (size_t)grid->size[2], rows = (size_t)(grid->size[1] - 1) / COARSE + 1;
    DistanceJob work = {.grid = grid, .tree = tree, .stop = stop};
    grid->value = malloc(distance_count(grid) * sizeof *grid->value);
    work.winding = calloc(distance_count(grid), sizeof *work.winding);
    bool ok = grid->value && work.winding;
    for (size_t i = 0; ok && i < distance_count(grid); i++)
        grid->value[i] = (float)(ROOM * grid->cell); /* for the last planes, outside all blocks */
    if (ok) {
        parallel_ranges(threads, rows * ((layers - 1) / COARSE + 1), 8, coarse_range, &work);
        parallel_ranges(threads, (layers - 1) / COARSE, 1, fine_range, &work);
        parallel_ranges(threads, tree->of->triangle_count, 64, cross_range, &work);
        parallel_ranges(threads, layers, 4, sign_range, &work);
        ok = !stop_wanted(stop) && (!grid->overlaps || leave_inner_surfaces(grid));
    }
    if (!ok)
        distance_free(grid);
    free(work.winding);
    return ok;
}

void distance_free(DistanceGrid *grid)
{
    free(grid->value);
    *grid = (DistanceGrid){0};
}

/* ---- reading the grid ---- */

/* A position on the grid: place t in the nearest cell (0 .. 1), corner values, and distance from the grid (0
   on the grid). */
typedef struct CellPosition {
    double t[3], corner[8], beyond;
} CellPosition;

static void spot_at(const DistanceGrid *grid, const double x[3], CellPosition *spot)
{
    double beyond2 = 0;
    int at[3];
    for (int k = 0; k < 3; k++) {
        const double along = (x[k] - grid->low[k]) / grid->cell, last = grid->size[k] - 1;
        const double in = fmin(fmax(along, 0), last), beyond = (along - in) * grid->cell;
        at[k] = (int)fmin(in, last - 1);
        spot->t[k] = in - at[k];
        beyond2 += beyond * beyond;
    }
    for (int c = 0; c < 8; c++)
        spot->corner[c] =
            grid->value[index_of(grid, at[0] + (c & 1), at[1] + (c >> 1 & 1), at[2] + (c >> 2))];
    spot->beyond = sqrt(beyond2);
}

/* Distance from x to the bounding box of the surface; 0 inside. */
static double outside(const DistanceGrid *grid, const double x[3])
{
    double sum = 0;
    for (int k = 0; k < 3; k++) {
        const double d = fmax(0, fabs(x[k]) - grid->inner[k]);
        sum += d * d;
    }
    return sqrt(sum);
}

static void slope_of(const DistanceGrid *grid, const CellPosition *spot, double slope[3])
{
    for (int k = 0; k < 3; k++) {
        double low[3], high[3];
        memcpy(low, spot->t, sizeof low);
        memcpy(high, spot->t, sizeof high);
        low[k] = 0, high[k] = 1;
        slope[k] = (between(spot->corner, high) - between(spot->corner, low)) / grid->cell;
    }
}

double distance_at(const DistanceGrid *grid, const double x[3], double slope[3])
{
    CellPosition spot;
    spot_at(grid, x, &spot);
    const double value = between(spot.corner, spot.t);
    if (slope)
        slope_of(grid, &spot, slope);
    return spot.beyond > 0 ? fmax(outside(grid, x), value - spot.beyond) : value;
}

double distance_deepest(const DistanceGrid *grid)
{
    float deepest = 0;
    for (size_t i = 0; i < distance_count(grid); i++)
        deepest = fminf(deepest, grid->value[i]);
    return -deepest;
}

/* Each value stands for a cell around the node, cut by the level perpendicular to the gradient. */
double distance_volume_below(const DistanceGrid *grid, double depth)
{
    const double cell = grid->cell;
    double sum = 0;
    for (size_t i = 0; i < distance_count(grid); i++)
        sum += fmin(fmax(0.5 + (-depth - grid->value[i]) / cell, 0), 1);
    return sum * cell * cell * cell;
}
