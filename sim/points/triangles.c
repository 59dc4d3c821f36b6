#include "sim/points/points.h"

#include "sim/base/base.h"
#include "sim/mesh.h"
#include "sim/points/walk.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { A_RANGE = 4096 };

static const double values_most = 0x1p28;   /* 1 GB */
static const double enlarged_most = 8;      /* a formula still has four cells per width */
static const double vertices_most = 0x1p24; /* 3 GB, with triangles */

/* The field on a grid with an extra layer beyond the bounds on each side, since the mesh is closed there. */
typedef struct Grid {
    const LineSearch *search;
    int size[3];     /* points */
    double cell[3];  /* m: point i at low + (i - 1) cell */
    double enlarged; /* factor on the cells requested by the field */
    size_t vertices; /* of the mesh, without the closing part */
    float *value;
} Grid;

/* The triangles inside the bounds. */
typedef struct TriangleSampling {
    size_t count, vertices;
    uint32_t (*corner)[3];
    float (*place)[3], (*normal)[3]; /* m; unit, of the vertices */
    double *area;                    /* m2 */
    float *own; /* alias table: probability to keep the drawn triangle; otherwise take `other` */
    uint32_t *other;
} TriangleSampling;

/* ---- the mesh ---- */

static void fill_rows(void *context, size_t begin, size_t end)
{
    const Grid *grid = context;
    const double *low = grid->search->low;
    const LevelField *field = grid->search->field;
    const size_t width = (size_t)grid->size[0], height = (size_t)grid->size[1];
    for (size_t row = begin; row < end; row++) {
        const size_t j = row % height, k = row / height;
        LanePlace p = {.y = f8_splat((float)(low[1] + ((double)j - 1) * grid->cell[1])),
                       .z = f8_splat((float)(low[2] + ((double)k - 1) * grid->cell[2]))};
        for (size_t i = 0; i < width; i += LANES) {
            LaneSample s;
            const size_t count = width - i < LANES ? width - i : LANES;
            for (size_t lane = 0; lane < LANES; lane++)
                p.x[lane] = (float)(low[0] + ((double)(i + lane) - 1) * grid->cell[0]);
            level_lanes(field, &p, &s);
            for (size_t lane = 0; lane < count; lane++)
                grid->value[row * width + i + lane] = s.value[lane];
        }
    }
}

/* A grid with about `times` the requested cells or the field's march. Returns the number of values. */
static double size_grid(const SurfaceRequest *request, double times, int size[3], double cell[3])
{
    double low[3], high[3], values = 1;
    request_bounds(request, low, high);
    for (int k = 0; k < 3; k++) {
        const double wanted = times * (request->cell > 0 ? request->cell : request->field->march[k]);
        const double side = high[k] - low[k], cells = fmin(fmax(ceil(side / wanted), 2), 1e6);
        cell[k] = side / cells;
        size[k] = (int)cells + 3;
        values *= size[k];
    }
    return values;
}

double triangles_grid(const SurfaceRequest *request, double times, int size[3], double cell[3])
{
    while (size_grid(request, times, size, cell) > values_most && !(request->cell > 0))
        times *= 1.1;
    return times;
}

/* Fills the grid, with cells at least `enlarged` times as large. */
static bool fill_grid(Grid *grid, const SurfaceRequest *request, Error *error)
{
    grid->enlarged = triangles_grid(request, grid->enlarged, grid->size, grid->cell);
    const double values = (double)grid->size[0] * grid->size[1] * grid->size[2];
    if (values > values_most)
        return error_set(error, "cells of %.3g m make a grid of %d x %d x %d values; take larger ones",
                         request->cell, grid->size[0], grid->size[1], grid->size[2]);
    if (grid->enlarged > enlarged_most)
        return error_set(error,
                         "triangles that fit into memory are %.3g times as wide as those of its field, and "
                         "would miss it; take the sampler walk",
                         grid->enlarged);
    free(grid->value);
    grid->value = malloc((size_t)values * sizeof *grid->value);
    if (!grid->value)
        return error_set(error, "no memory for a grid of %d x %d x %d values", grid->size[0], grid->size[1],
                         grid->size[2]);
    parallel_ranges(grid->search->threads, (size_t)grid->size[1] * (size_t)grid->size[2], 1, fill_rows, grid);
    return true;
}

/* Counts edges of the grid across the level from values of some rows: each is a vertex. */
static void count_rows(void *context, size_t begin, size_t end)
{
    Grid *grid = context;
    const float level = (float)grid->search->level;
    const size_t width = (size_t)grid->size[0], height = (size_t)grid->size[1], depth = (size_t)grid->size[2];
    size_t found = 0;
    for (size_t row = begin; row < end; row++) {
        const float *v = grid->value + row * width;
        const bool next_y = row % height + 1 < height, next_z = row / height + 1 < depth;
        for (size_t i = 0; i < width; i++) {
            const bool inside = v[i] >= level;
            found += i + 1 < width && (v[i + 1] >= level) != inside;
            found += next_y && (v[i + width] >= level) != inside;
            found += next_z && (v[i + width * height] >= level) != inside;
        }
    }
    __atomic_fetch_add(&grid->vertices, found, __ATOMIC_RELAXED); /* integers: independent of order */
}

/* Enlarges cells until the mesh fits too: the number of vertices follows the number of cells on the
   surface. */
static bool grid_fill(Grid *grid, const SurfaceRequest *request, Error *error)
{
    grid->enlarged = 1;
    while (fill_grid(grid, request, error)) {
        grid->vertices = 0;
        parallel_ranges(grid->search->threads, (size_t)grid->size[1] * (size_t)grid->size[2], 16, count_rows,
                        grid);
        if ((double)grid->vertices <= vertices_most)
            return true;
        if (request->cell > 0)
            return error_set(error, "cells of %.3g m make a mesh of %zu vertices; take larger ones",
                             request->cell, grid->vertices);
        grid->enlarged *= fmax(1.1, sqrt((double)grid->vertices / vertices_most));
    }
    return false;
}

static bool grid_sound(const Grid *grid, double level, Error *error)
{
    const size_t count = (size_t)grid->size[0] * (size_t)grid->size[1] * (size_t)grid->size[2];
    float least = INFINITY, most = -INFINITY;
    for (size_t i = 0; i < count; i++) {
        const size_t width = (size_t)grid->size[0], height = (size_t)grid->size[1];
        const size_t at[3] = {i % width, i / width % height, i / width / height};
        if (!isfinite(grid->value[i]))
            return error_set(error, "the field is no number at (%.4g, %.4g, %.4g) m",
                             grid->search->low[0] + ((double)at[0] - 1) * grid->cell[0],
                             grid->search->low[1] + ((double)at[1] - 1) * grid->cell[1],
                             grid->search->low[2] + ((double)at[2] - 1) * grid->cell[2]);
        least = fminf(least, grid->value[i]);
        most = fmaxf(most, grid->value[i]);
    }
    if (level <= (double)least || level > (double)most)
        return error_set(
            error, "level %.6g is out of range: at the corners of cells the field goes from %.6g to %.6g",
            level, (double)least, (double)most);
    return true;
}

static bool kept(const uint8_t *inside, const uint32_t corner[3])
{
    return inside[corner[0]] && inside[corner[1]] && inside[corner[2]];
}

static double area_of(const TriangleSampling *t, const uint32_t corner[3])
{
    double u[3], v[3];
    for (int k = 0; k < 3; k++) {
        u[k] = (double)t->place[corner[1]][k] - (double)t->place[corner[0]][k];
        v[k] = (double)t->place[corner[2]][k] - (double)t->place[corner[0]][k];
    }
    const double n[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    return 0.5 * sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
}

/* Sets positions and normals; inside[i]: 1 if vertex i is within the bounds and not on the closing part. */
static void set_vertices(const Grid *grid, const IsoMesh *mesh, TriangleSampling *t, uint8_t *inside)
{
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        double place[3];
        isosurface_place(mesh, i, place);
        isosurface_slope(mesh, i, grid->value, t->normal[i]);
        inside[i] = 1;
        for (int k = 0; k < 3; k++) {
            inside[i] &= place[k] >= 1 && place[k] <= grid->size[k] - 2;
            t->place[i][k] = (float)(grid->search->low[k] + (place[k] - 1) * grid->cell[k]);
            t->normal[i][k] /= (float)grid->cell[k];
        }
    }
}

static double set_triangles(const IsoMesh *mesh, TriangleSampling *t, const uint8_t *inside)
{
    double sum = 0;
    for (size_t i = 0; i < mesh->triangle_count; i++) {
        if (!kept(inside, mesh->triangle[i]))
            continue;
        memcpy(t->corner[t->count], mesh->triangle[i], sizeof t->corner[0]);
        sum += t->area[t->count++] = area_of(t, mesh->triangle[i]);
    }
    return sum;
}

static bool reserve(TriangleSampling *t, const IsoMesh *mesh, uint8_t **inside, Error *error)
{
    const size_t v = mesh->vertex_count + 1, n = mesh->triangle_count + 1;
    t->corner = malloc(n * sizeof *t->corner);
    t->place = malloc(v * sizeof *t->place);
    t->normal = malloc(v * sizeof *t->normal);
    t->area = malloc(n * sizeof *t->area);
    t->own = malloc(n * sizeof *t->own);
    t->other = malloc(n * sizeof *t->other);
    *inside = malloc(v);
    if (t->corner && t->place && t->normal && t->area && t->own && t->other && *inside)
        return true;
    error_set(error, "no memory for points on %zu triangles", mesh->triangle_count);
    return false;
}

static void triangles_free(TriangleSampling *t)
{
    free(t->corner);
    free(t->place);
    free(t->normal);
    free(t->area);
    free(t->own);
    free(t->other);
}

/* ---- drawing a triangle ---- */

/* Builds an alias table to draw triangles by area with a number and a comparison. After: M. Vose, "A linear
   algorithm for generating random numbers with a given distribution", 1991. Destroys `area`. */
static bool make_alias(TriangleSampling *t, double sum, Error *error)
{
    uint32_t *stack = malloc((t->count + 1) * sizeof *stack);
    size_t small = 0, large = t->count; /* small entries from below, large entries from above */
    if (!stack)
        return error_set(error, "no memory for points on %zu triangles", t->count);
    for (size_t i = 0; i < t->count; i++) {
        t->area[i] *= (double)t->count / sum;
        stack[t->area[i] < 1 ? small++ : --large] = (uint32_t)i;
    }
    while (small > 0 && large < t->count) {
        const uint32_t less = stack[--small], more = stack[large];
        t->own[less] = (float)t->area[less];
        t->other[less] = more;
        t->area[more] -= 1 - t->area[less];
        if (t->area[more] < 1) {
            large++;
            stack[small++] = more;
        }
    }
    for (size_t i = 0; i < small; i++)
        t->own[stack[i]] = 1;
    for (size_t i = large; i < t->count; i++)
        t->own[stack[i]] = 1;
    free(stack);
    return true;
}

/* ---- points ---- */

typedef struct Scatter {
    const TriangleSampling *triangles;
    const SurfaceRequest *request;
    PhiloxKey key;
    SurfacePoint *point;
} Scatter;

/* A uniform point on a triangle. After: G. Turk, "Generating random points in triangles", Graphics Gems,
   1990. */
static SurfacePoint point_on(const Scatter *scatter, uint32_t triangle, float u, float v)
{
    const TriangleSampling *t = scatter->triangles;
    const uint32_t *corner = t->corner[triangle];
    const float root = sqrtf(u), share[3] = {1 - root, root * (1 - v), root * v};
    SurfacePoint point = {.surface = scatter->request->surface, .value = (float)scatter->request->level};
    float normal[3] = {0};
    for (int c = 0; c < 3; c++)
        for (int k = 0; k < 3; k++) {
            point.position[k] += share[c] * t->place[corner[c]][k];
            normal[k] += share[c] * t->normal[corner[c]][k];
        }
    point.normal = surface_normal_pack(normal);
    return point;
}

/* The i-th point; its random numbers have the counter {i, i / 2^32, 0, PHILOX_TRIANGLES}. */
static void scatter_range(void *context, size_t begin, size_t end)
{
    const Scatter *scatter = context;
    const TriangleSampling *t = scatter->triangles;
    for (size_t i = begin; i < end; i++) {
        uint32_t word[4] = {(uint32_t)i, (uint32_t)(i >> 32), 0, PHILOX_TRIANGLES};
        philox(scatter->key, word);
        uint32_t triangle = (uint32_t)((uint64_t)word[0] * t->count >> 32);
        if (philox_uniform(word[3]) >= t->own[triangle])
            triangle = t->other[triangle];
        scatter->point[i] = point_on(scatter, triangle, philox_uniform(word[1]), philox_uniform(word[2]));
    }
}

static bool scatter_points(const SurfaceRequest *request, const LineSearch *search, const TriangleSampling *t,
                           double area, SurfacePoints *points, SurfaceResult *result, Error *error)
{
    const double wanted = rint(request->density * request->sets * area);
    const size_t count = (size_t)fmin(wanted, (double)request_points_most(request));
    *result = (SurfaceResult){.area = area};
    if (count == 0) /* so thin that rounding gives none */
        return true;
    if (!surface_points_reserve(points, points->count + count, error))
        return false;
    Scatter scatter = {t, request, search->key, points->point + points->count};
    parallel_ranges(search->threads, count, A_RANGE, scatter_range, &scatter);
    points->count += count;
    *result = (SurfaceResult){.points = count,
                              .area = area,
                              .density = (double)count / area / request->sets,
                              .reached = (double)count >= wanted};
    return true;
}

static bool on_mesh(const SurfaceRequest *request, const Grid *grid, const IsoMesh *mesh,
                    SurfacePoints *points, SurfaceResult *result, Error *error)
{
    TriangleSampling t = {0};
    uint8_t *inside = NULL;
    bool ok = reserve(&t, mesh, &inside, error);
    if (ok) {
        set_vertices(grid, mesh, &t, inside);
        const double area = set_triangles(mesh, &t, inside);
        ok = area > 0 ? make_alias(&t, area, error)
                      : error_set(error, "level %.6g is empty: no cell of %.3g m has a part of it",
                                  request->level, grid->cell[0]);
        ok = ok && scatter_points(request, grid->search, &t, area, points, result, error);
        if (ok && grid->enlarged > 1)
            result_note(
                result,
                "its cells are %.3g times as wide as those of its field, of which there would be too many",
                grid->enlarged);
    }
    free(inside);
    triangles_free(&t);
    return ok;
}

bool triangles_sample(const SurfaceRequest *request, const LineSearch *search, SurfacePoints *points,
                      SurfaceResult *result, Error *error)
{
    Grid grid = {.search = search};
    IsoMesh mesh = {0};
    const bool ok = grid_fill(&grid, request, error) && grid_sound(&grid, request->level, error) &&
                    isosurface(grid.size, grid.value, (float)request->level, &mesh, error) &&
                    on_mesh(request, &grid, &mesh, points, result, error);
    isosurface_free(&mesh);
    free(grid.value);
    return ok;
}

/* ---- an existing mesh ---- */

/* Borrows the arrays of a mesh and computes the areas. Returns the total area, m2. */
static double take_polygons(TriangleSampling *t, const Polygons *polygons)
{
    double sum = 0;
    t->count = polygons->triangle_count;
    t->corner = polygons->corner;
    t->place = polygons->place;
    t->normal = polygons->normal;
    for (size_t i = 0; i < t->count; i++)
        sum += t->area[i] = area_of(t, t->corner[i]);
    return sum;
}

double polygons_area(const Polygons *polygons)
{
    const TriangleSampling t = {.corner = polygons->corner, .place = polygons->place};
    double sum = 0;
    for (size_t i = 0; i < polygons->triangle_count; i++)
        sum += area_of(&t, t.corner[i]);
    return sum;
}

bool polygons_sample(const Polygons *polygons, const SurfaceRequest *request, SurfacePoints *points,
                     SurfaceResult *result, Error *error)
{
    const LineSearch search = {.key = philox_key(request->seed),
                               .threads = request->threads > 0 ? request->threads : parallel_processors()};
    const size_t n = polygons->triangle_count + 1;
    TriangleSampling t = {.area = malloc(n * sizeof *t.area),
                          .own = malloc(n * sizeof *t.own),
                          .other = malloc(n * sizeof *t.other)};
    *result = (SurfaceResult){0};
    bool ok = t.area && t.own && t.other;
    if (!ok)
        error_set(error, "no memory for points on %zu triangles", polygons->triangle_count);
    if (ok) {
        const double area = take_polygons(&t, polygons);
        ok = area > 0 && isfinite(area)
                 ? make_alias(&t, area, error)
                 : error_set(error, "its %zu triangles have no area", polygons->triangle_count);
        ok = ok && scatter_points(request, &search, &t, area, points, result, error);
    }
    free(t.area);
    free(t.own);
    free(t.other);
    return ok;
}
