#include "sim/base/base.h"
#include "sim/mesh/mesh_shape.h"
#include "sim/solids/solid.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* All lengths in this file are in spacings. */
enum { TRIES = 14, ROUNDS = 40 };
static const double STEP = 0.4;                    /* of the lattice from which points are thrown */
static const double NEAREST = 0.5, FARTHEST = 1.2; /* range of the least distance between thrown points */
static const double REACH = 1.7;                  /* range of the push: just includes the second neighbours */
static const double PUSH = 0.12, MOST = 0.1;      /* per round: factor of the push, and greatest way along an
                                                     axis */
static const double GAP = 0.86;                   /* a place this far from all layers is empty */
static const double ASIDE = 0.75, SHARPEST = 0.9; /* of differences for curvature; most of the curvature */
static const double THIN = 0.45, LEAST = 0.02;    /* half thickness: too thin for a layer, and for any
                                                     particle */

typedef struct PointList {
    double (*x)[3];
    size_t count, capacity;
} PointList;

/* The mesh with lengths in spacings. */
typedef struct ScaledMesh {
    const DistanceGrid *grid;
    double unit; /* spacings per unit of the mesh */
    double half[3];
} ScaledMesh;

static double body_at(const ScaledMesh *body, const double x[3], double slope[3])
{
    const double at[3] = {x[0] / body->unit, x[1] / body->unit, x[2] / body->unit};
    return body->unit * distance_at(body->grid, at, slope);
}

static bool points_add(PointList *points, const double x[3])
{
    if (points->count == points->capacity) {
        const size_t capacity = points->capacity ? 2 * points->capacity : 1024;
        double(*moved)[3] = realloc(points->x, capacity * sizeof *moved);
        if (!moved)
            return false;
        points->x = moved;
        points->capacity = capacity;
    }
    memcpy(points->x[points->count++], x, 3 * sizeof *x);
    return true;
}

/* ---- points by cells ---- */

typedef struct PointCells {
    double low[3], side;
    long size[3];
    uint32_t *first, *next; /* index of a point, plus 1; 0: none */
} PointCells;

static bool cells_make(PointCells *cells, const ScaledMesh *body, double side, size_t points)
{
    cells->side = side;
    for (int k = 0; k < 3; k++) {
        cells->low[k] = -body->half[k] - 1;
        cells->size[k] = (long)(2 * (body->half[k] + 1) / side) + 1;
    }
    cells->first = calloc((size_t)(cells->size[0] * cells->size[1] * cells->size[2]), sizeof *cells->first);
    cells->next = malloc((points + 1) * sizeof *cells->next);
    return cells->first && cells->next;
}

static void cells_free(PointCells *cells)
{
    free(cells->first);
    free(cells->next);
}

static void cells_clear(PointCells *cells)
{
    memset(cells->first, 0,
           (size_t)(cells->size[0] * cells->size[1] * cells->size[2]) * sizeof *cells->first);
}

static long cell_along(const PointCells *cells, int k, double x)
{
    const long at = (long)floor((x - cells->low[k]) / cells->side);
    return at < 0 ? 0 : at < cells->size[k] ? at : cells->size[k] - 1;
}

static uint32_t *cell_of(const PointCells *cells, const double x[3])
{
    return &cells->first[cell_along(cells, 0, x[0]) +
                         cells->size[0] *
                             (cell_along(cells, 1, x[1]) + cells->size[1] * cell_along(cells, 2, x[2]))];
}

static void cells_add(PointCells *cells, size_t point, const double x[3])
{
    uint32_t *first = cell_of(cells, x);
    cells->next[point] = *first;
    *first = (uint32_t)point + 1;
}

/* Called for each point in the cells within `reach` of x, until a call returns false. */
typedef bool Visit(void *context, size_t point);

static bool cells_visit(const PointCells *cells, const double x[3], double reach, Visit *visit, void *context)
{
    long begin[3], end[3], at[3];
    for (int k = 0; k < 3; k++) {
        begin[k] = cell_along(cells, k, x[k] - reach);
        end[k] = cell_along(cells, k, x[k] + reach);
    }
    for (at[2] = begin[2]; at[2] <= end[2]; at[2]++)
        for (at[1] = begin[1]; at[1] <= end[1]; at[1]++)
            for (at[0] = begin[0]; at[0] <= end[0]; at[0]++)
                for (uint32_t p = cells->first[at[0] + cells->size[0] * (at[1] + cells->size[1] * at[2])]; p;
                     p = cells->next[p - 1])
                    if (!visit(context, p - 1))
                        return false;
    return true;
}

/* ---- throwing points ---- */

/* Move x along the slope to the level; false if the level is not near. */
static bool to_level(const ScaledMesh *body, double level, double x[3])
{
    for (int i = 0; i < 6; i++) {
        double slope[3];
        const double off = body_at(body, x, slope) - level;
        const double slope2 = slope[0] * slope[0] + slope[1] * slope[1] + slope[2] * slope[2];
        if (fabs(off) < 0.01)
            return true;
        if (slope2 < 0.04)
            return false;
        for (int k = 0; k < 3; k++)
            x[k] -= fmin(fmax(off / slope2, -0.5), 0.5) * slope[k];
    }
    return false;
}

/* Handles a lattice point x at `distance` from the surface; false stops the walk. */
typedef bool Take(void *context, const double x[3], double distance);

/* Calls `take` for the lattice points whose distance is from `low` to `high`; false if a call returned
   false. */
static bool walk(const ScaledMesh *body, double low, double high, Take *take, void *context)
{
    long size[3], i[3];
    for (int k = 0; k < 3; k++)
        size[k] = (long)ceil(2 * body->half[k] / STEP) | 1; /* odd: a point in the middle */
    for (i[2] = 0; i[2] < size[2]; i[2]++)
        for (i[1] = 0; i[1] < size[1]; i[1]++)
            for (i[0] = 0; i[0] < size[0]; i[0]++) {
                double x[3];
                for (int k = 0; k < 3; k++)
                    x[k] = ((double)i[k] - 0.5 * (double)(size[k] - 1)) * STEP;
                const double d = body_at(body, x, NULL), off = d < low ? low - d : d > high ? d - high : 0;
                if (off == 0 && !take(context, x, d))
                    return false;
                i[0] += off > 2 * STEP ? (long)(0.7 * off / STEP) : 0; /* the distance grows by little more
                                                                          than 1 per length */
            }
    return true;
}

typedef struct LayerBuild {
    const ScaledMesh *body;
    double level;
    PointList points;
    uint32_t thrown;
} LayerBuild;

/* Offset from the lattice point at random: else points on a plane face would lie in steps. */
static bool throw_one(void *context, const double x[3], double distance)
{
    LayerBuild *layer = context;
    double at[3];
    (void)distance;
    for (int k = 0; k < 3; k++)
        at[k] = x[k] + STEP * (hash_mix(layer->thrown++) * 0x1p-32 - 0.5);
    return !to_level(layer->body, layer->level, at) || points_add(&layer->points, at);
}

/* Random order, the same in each run. */
static void shuffle(PointList *points)
{
    for (size_t i = points->count; i > 1; i--) {
        const size_t j = hash_mix((uint32_t)i) % i;
        double x[3];
        memcpy(x, points->x[i - 1], sizeof x);
        memcpy(points->x[i - 1], points->x[j], sizeof x);
        memcpy(points->x[j], x, sizeof x);
    }
}

/* For is_clear: true if `at` is at least sqrt(apart2) from all points. */
typedef struct ClearanceTest {
    const double (*x)[3];
    const double *at;
    double apart2;
} ClearanceTest;

static bool is_clear(void *context, size_t point)
{
    const ClearanceTest *clear = context;
    double d2 = 0;
    for (int k = 0; k < 3; k++)
        d2 += (clear->x[point][k] - clear->at[k]) * (clear->x[point][k] - clear->at[k]);
    return d2 >= clear->apart2;
}

/* Mark the points at least `apart` from all points marked before; returns the number of marked points. */
static size_t thin(const PointList *points, PointCells *cells, double apart, bool *kept)
{
    size_t count = 0;
    cells_clear(cells);
    for (size_t i = 0; i < points->count; i++) {
        ClearanceTest clear = {(const double(*)[3])points->x, points->x[i], apart * apart};
        kept[i] = cells_visit(cells, points->x[i], apart, is_clear, &clear);
        if (kept[i])
            cells_add(cells, i, points->x[i]);
        count += kept[i];
    }
    return count;
}

/* Thin to `wanted` points, as nearly as possible. */
static void thin_to(PointList *points, PointCells *cells, size_t wanted, bool *kept)
{
    double low = NEAREST, high = FARTHEST;
    size_t count = 0;
    for (int i = 0; i < TRIES; i++) {
        const double apart = 0.5 * (low + high);
        const size_t found = thin(points, cells, apart, kept);
        if (found == wanted)
            break;
        if (found > wanted)
            low = apart;
        else
            high = apart;
    }
    for (size_t i = 0; i < points->count; i++)
        if (kept[i])
            memcpy(points->x[count++], points->x[i], sizeof *points->x);
    points->count = count;
}

/* ---- pushing points apart ---- */

typedef struct PointPush {
    const double (*x)[3];
    size_t of;
    double sum[3];
} PointPush;

static bool push_from(void *context, size_t point)
{
    PointPush *push = context;
    double d[3], d2 = 0;
    for (int k = 0; k < 3; k++) {
        d[k] = push->x[push->of][k] - push->x[point][k];
        d2 += d[k] * d[k];
    }
    if (point == push->of || d2 >= REACH * REACH || d2 == 0)
        return true;
    const double r = sqrt(d2), t = 1 - r / REACH;
    for (int k = 0; k < 3; k++)
        push->sum[k] += PUSH * t * t / (r * r) * d[k];
    return true;
}

/* One round of pushes: all use the positions before the round. */
static void relax(const LayerBuild *layer, PointCells *cells, double (*moved)[3])
{
    const PointList *points = &layer->points;
    cells_clear(cells);
    for (size_t i = 0; i < points->count; i++)
        cells_add(cells, i, points->x[i]);
    for (size_t i = 0; i < points->count; i++) {
        PointPush push = {.x = (const double(*)[3])points->x, .of = i};
        cells_visit(cells, points->x[i], REACH, push_from, &push);
        for (int k = 0; k < 3; k++)
            moved[i][k] = points->x[i][k] + fmin(fmax(push.sum[k], -MOST), MOST);
        if (!to_level(layer->body, layer->level, moved[i]))
            memcpy(moved[i], points->x[i], sizeof *moved);
    }
    memcpy(points->x, moved, points->count * sizeof *moved);
}

/* ---- layers ---- */

static bool even(LayerBuild *layer, size_t wanted)
{
    PointList *points = &layer->points;
    PointCells cells;
    bool *kept = malloc(points->count + 1);
    double(*moved)[3] = malloc((points->count + 1) * sizeof *moved);
    bool ok = cells_make(&cells, layer->body, 1, points->count) && kept && moved;
    if (ok) {
        shuffle(points);
        thin_to(points, &cells, wanted, kept);
        for (int i = 0; i < ROUNDS; i++)
            relax(layer, &cells, moved);
    }
    cells_free(&cells);
    free(kept);
    free(moved);
    return ok;
}

/* Area of the level, from the volume of a shell around the level. */
static double area_of(const ScaledMesh *body, double level)
{
    const double unit = body->unit, half = fmax(0.25, body->grid->cell * unit);
    const double volume = distance_volume_below(body->grid, (-level - half) / unit) -
                          distance_volume_below(body->grid, (-level + half) / unit);
    return volume * unit * unit * unit / (2 * half);
}

/* Move x to the middle of the matter of its layer. Behind a curved surface there is more of the matter in the
   outer half, by a twelfth of the sum of curvatures: as mean_radius of sim/solids/boundary.c. */
static void to_matter(const ScaledMesh *body, double x[3])
{
    double slope[3], bend = 0;
    const double d = body_at(body, x, slope);
    for (int k = 0; k < 3; k++)
        for (int side = -1; side <= 1; side += 2) {
            double at[3] = {x[0], x[1], x[2]};
            at[k] += side * ASIDE;
            bend += (body_at(body, at, NULL) - d) / (ASIDE * ASIDE);
        }
    for (int k = 0; k < 3; k++)
        x[k] += fmin(fmax(bend, -SHARPEST), SHARPEST) / 12 * slope[k];
}

static bool add_layer(const ScaledMesh *body, double level, PointList *all)
{
    LayerBuild layer = {.body = body, .level = level};
    bool ok = walk(body, level - 0.7, level + 0.7, throw_one, &layer) &&
              (layer.points.count == 0 || even(&layer, (size_t)lround(area_of(body, level))));
    for (size_t i = 0; ok && i < layer.points.count; i++) {
        to_matter(body, layer.points.x[i]);
        ok = points_add(all, layer.points.x[i]);
    }
    free(layer.points.x);
    return ok;
}

/* ---- gaps without a layer ---- */

typedef struct GapFill {
    const ScaledMesh *body;
    PointCells cells;
    PointList *all;
    size_t capacity;
} GapFill;

/* Move x inwards to the middle of a part too thin for a layer; false if there is no such part. */
static bool to_middle(const ScaledMesh *body, double x[3])
{
    double deepest = INFINITY, at[3] = {x[0], x[1], x[2]};
    for (int i = 0; i < 8; i++) {
        double slope[3];
        const double d = body_at(body, at, slope);
        const double length = sqrt(slope[0] * slope[0] + slope[1] * slope[1] + slope[2] * slope[2]);
        if (d < -THIN)
            return false;
        if (d < deepest) {
            deepest = d;
            memcpy(x, at, sizeof at);
        }
        for (int k = 0; k < 3 && length > 0.05; k++)
            at[k] -= 0.1 / length * slope[k];
    }
    return deepest < -LEAST;
}

static bool fill_gap(void *context, const double at[3], double distance)
{
    GapFill *gaps = context;
    double x[3] = {at[0], at[1], at[2]};
    ClearanceTest clear = {(const double(*)[3])gaps->all->x, x, GAP * GAP};
    if (distance > -THIN && !to_middle(gaps->body, x))
        return true;
    if (gaps->all->count == gaps->capacity || !cells_visit(&gaps->cells, x, GAP, is_clear, &clear))
        return true;
    if (!points_add(gaps->all, x))
        return false;
    cells_add(&gaps->cells, gaps->all->count - 1, x);
    return true;
}

static bool fill_gaps(const ScaledMesh *body, double deepest, PointList *all)
{
    const double most = 8 * (body->half[0] + 1) * (body->half[1] + 1) * (body->half[2] + 1);
    GapFill gaps = {.body = body, .all = all, .capacity = all->count + (size_t)(4 * most) + 64};
    bool ok = cells_make(&gaps.cells, body, 1, gaps.capacity);
    for (size_t i = 0; ok && i < all->count; i++)
        cells_add(&gaps.cells, i, all->x[i]);
    ok = ok && walk(body, deepest, 0.5 * STEP, fill_gap, &gaps);
    cells_free(&gaps.cells);
    return ok;
}

float *boundary_mesh_layers(const MeshUse *mesh, double spacing, double depth, size_t *count)
{
    const MeshShape *shape = mesh->shape;
    ScaledMesh body = {.grid = &shape->distance, .unit = mesh->scale / spacing};
    PointList all = {0};
    const double core = -shape->depth * body.unit;
    double level = -0.5;
    bool ok = true;
    for (int k = 0; k < 3; k++)
        body.half[k] = shape->half[k] * body.unit;
    for (; ok && -level - 0.5 < depth / spacing && level > core; level--)
        ok = add_layer(&body, level, &all);
    ok = ok && fill_gaps(&body, level > core ? level + 1 : core, &all);
    float *position = ok ? malloc((3 * all.count + 1) * sizeof *position) : NULL;
    for (size_t i = 0; position && i < 3 * all.count; i++)
        position[i] = (float)(all.x[i / 3][i % 3] * spacing);
    *count = all.count;
    free(all.x);
    return position;
}
