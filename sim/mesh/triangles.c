#include "sim/mesh/triangles.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void triangles_free(Triangles *triangles)
{
    free(triangles->vertex);
    free(triangles->triangle);
    *triangles = (Triangles){0};
}

void triangles_bounds(const Triangles *triangles, double low[3], double high[3])
{
    for (int k = 0; k < 3; k++) {
        low[k] = INFINITY, high[k] = -INFINITY;
        for (size_t i = 0; i < triangles->vertex_count; i++) {
            low[k] = fmin(low[k], triangles->vertex[i][k]);
            high[k] = fmax(high[k], triangles->vertex[i][k]);
        }
    }
}

static void sides_of(const Triangles *triangles, size_t t, double a[3], double b[3])
{
    const uint32_t *corner = triangles->triangle[t];
    for (int k = 0; k < 3; k++) {
        const double first = triangles->vertex[corner[0]][k];
        a[k] = triangles->vertex[corner[1]][k] - first;
        b[k] = triangles->vertex[corner[2]][k] - first;
    }
}

void triangle_normal(const Triangles *triangles, size_t t, double normal[3])
{
    double a[3], b[3];
    sides_of(triangles, t, a, b);
    normal[0] = a[1] * b[2] - a[2] * b[1];
    normal[1] = a[2] * b[0] - a[0] * b[2];
    normal[2] = a[0] * b[1] - a[1] * b[0];
}

static double length(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* By the cone of each triangle from the origin. */
double triangles_volume(const Triangles *triangles)
{
    double sum = 0, normal[3];
    for (size_t t = 0; t < triangles->triangle_count; t++) {
        const float *corner = triangles->vertex[triangles->triangle[t][0]];
        triangle_normal(triangles, t, normal);
        sum += corner[0] * normal[0] + corner[1] * normal[1] + corner[2] * normal[2];
    }
    return sum / 6;
}

double triangles_area(const Triangles *triangles)
{
    double sum = 0, normal[3];
    for (size_t t = 0; t < triangles->triangle_count; t++) {
        triangle_normal(triangles, t, normal);
        sum += 0.5 * length(normal);
    }
    return sum;
}

static bool all_finite(const Triangles *triangles, Error *error)
{
    for (size_t i = 0; i < triangles->vertex_count; i++)
        for (int k = 0; k < 3; k++)
            if (!isfinite(triangles->vertex[i][k]))
                return error_set(error, "%c of vertex %zu of %zu is no finite number; mend the file",
                                 "xyz"[k], i + 1, triangles->vertex_count);
    return true;
}

/* ---- welding ---- */

/* Vertices by their places, on a lattice of 2^20 along the longest side of the whole. */
typedef struct Weld {
    uint64_t *key;  /* of each slot; 0: free */
    uint32_t *name; /* the new number */
    size_t slots;
} Weld;

static uint64_t place_of(const float x[3], const double low[3], double step)
{
    uint64_t key = 1; /* so that no key is 0 */
    for (int k = 0; k < 3; k++)
        key = key << 21 | (uint64_t)lround((x[k] - low[k]) / step);
    return key;
}

/* The slot of the key, or the free one that it belongs to. */
static size_t slot_of(const Weld *weld, uint64_t key)
{
    uint64_t h = key * 0x9e3779b97f4a7c15ULL;
    size_t slot = (size_t)(h >> 20) & (weld->slots - 1);
    while (weld->key[slot] && weld->key[slot] != key)
        slot = (slot + 1) & (weld->slots - 1);
    return slot;
}

/* `name`: of each vertex, its new number. */
static void weld_all(Triangles *triangles, Weld *weld, uint32_t *name)
{
    double low[3], high[3];
    size_t kept = 0;
    triangles_bounds(triangles, low, high);
    const double longest = fmax(fmax(high[0] - low[0], high[1] - low[1]), high[2] - low[2]);
    const double step = longest > 0 ? longest * 0x1p-20 : 1;
    for (size_t i = 0; i < triangles->vertex_count; i++) {
        const uint64_t key = place_of(triangles->vertex[i], low, step);
        const size_t slot = slot_of(weld, key);
        if (!weld->key[slot]) {
            weld->key[slot] = key;
            weld->name[slot] = (uint32_t)kept;
            memmove(triangles->vertex[kept++], triangles->vertex[i], sizeof *triangles->vertex);
        }
        name[i] = weld->name[slot];
    }
    triangles->vertex_count = kept;
}

static bool weld_vertices(Triangles *triangles)
{
    Weld weld = {.slots = 16};
    while (weld.slots < 2 * triangles->vertex_count)
        weld.slots *= 2;
    weld.key = calloc(weld.slots, sizeof *weld.key);
    weld.name = malloc(weld.slots * sizeof *weld.name);
    uint32_t *name = malloc((triangles->vertex_count + 1) * sizeof *name);
    const bool ok = weld.key && weld.name && name;
    if (ok) {
        weld_all(triangles, &weld, name);
        for (size_t t = 0; t < triangles->triangle_count; t++)
            for (int c = 0; c < 3; c++)
                triangles->triangle[t][c] = name[triangles->triangle[t][c]];
    }
    free(weld.key);
    free(weld.name);
    free(name);
    return ok;
}

/* ---- triangles without area ---- */

/* Corners that coincide leave an edge that is there and back: without such a triangle the rest is as closed
   as with it. One whose corners stand in a line may be all that joins its neighbours, so it stays. */
static size_t drop_flat(Triangles *triangles)
{
    double low[3], high[3], extent[3], normal[3];
    size_t kept = 0, flat = 0;
    triangles_bounds(triangles, low, high);
    for (int k = 0; k < 3; k++)
        extent[k] = high[k] - low[k];
    const double none = 1e-14 * length(extent) * length(extent);
    for (size_t t = 0; t < triangles->triangle_count; t++) {
        const uint32_t *corner = triangles->triangle[t];
        triangle_normal(triangles, t, normal);
        flat += length(normal) <= none;
        if (corner[0] != corner[1] && corner[1] != corner[2] && corner[2] != corner[0])
            memmove(triangles->triangle[kept++], corner, sizeof *triangles->triangle);
    }
    triangles->triangle_count = kept;
    return flat;
}

static bool drop_unused(Triangles *triangles)
{
    uint32_t *name = calloc(triangles->vertex_count + 1, sizeof *name);
    size_t kept = 0;
    if (!name)
        return false;
    for (size_t t = 0; t < triangles->triangle_count; t++)
        for (int c = 0; c < 3; c++)
            name[triangles->triangle[t][c]] = 1;
    for (size_t i = 0; i < triangles->vertex_count; i++)
        if (name[i]) {
            memmove(triangles->vertex[kept], triangles->vertex[i], sizeof *triangles->vertex);
            name[i] = (uint32_t)kept++;
        }
    for (size_t t = 0; t < triangles->triangle_count; t++)
        for (int c = 0; c < 3; c++)
            triangles->triangle[t][c] = name[triangles->triangle[t][c]];
    triangles->vertex_count = kept;
    free(name);
    return true;
}

/* ---- edges ---- */

static int ascending(const void *a, const void *b)
{
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

/* Each edge once for each of its triangles: the lesser vertex, the greater one, and which way it runs. */
static uint64_t *sorted_edges(const Triangles *triangles)
{
    const size_t count = 3 * triangles->triangle_count;
    uint64_t *edge = malloc((count + 1) * sizeof *edge);
    if (!edge)
        return NULL;
    for (size_t i = 0; i < count; i++) {
        const uint64_t from = triangles->triangle[i / 3][i % 3], to = triangles->triangle[i / 3][(i + 1) % 3];
        edge[i] = from < to ? from << 33 | to << 1 : to << 33 | from << 1 | 1;
    }
    qsort(edge, count, sizeof *edge, ascending);
    return edge;
}

static bool count_edges(const Triangles *triangles, TrianglesState *state)
{
    const size_t count = 3 * triangles->triangle_count;
    uint64_t *edge = sorted_edges(triangles);
    if (!edge)
        return false;
    for (size_t i = 0, end; i < count; i = end) {
        size_t back = 0;
        for (end = i; end < count && edge[end] >> 1 == edge[i] >> 1; end++)
            back += edge[end] & 1;
        if ((end - i) % 2 == 1)
            state->open++;
        else if (2 * back != end - i)
            state->opposed++;
    }
    free(edge);
    return true;
}

/* ---- place and turn ---- */

static void centre(Triangles *triangles, double middle[3])
{
    double low[3], high[3];
    triangles_bounds(triangles, low, high);
    for (int k = 0; k < 3; k++) {
        middle[k] = 0.5 * (low[k] + high[k]);
        for (size_t i = 0; i < triangles->vertex_count; i++)
            triangles->vertex[i][k] = (float)(triangles->vertex[i][k] - middle[k]);
    }
}

static bool turn_outwards(Triangles *triangles)
{
    if (triangles_volume(triangles) >= 0)
        return false;
    for (size_t t = 0; t < triangles->triangle_count; t++) {
        uint32_t *corner = triangles->triangle[t], second = corner[1];
        corner[1] = corner[2];
        corner[2] = second;
    }
    return true;
}

bool triangles_mend(Triangles *triangles, double middle[3], TrianglesState *state, Error *error)
{
    *state = (TrianglesState){0};
    if (!all_finite(triangles, error))
        return false;
    if (!weld_vertices(triangles))
        return error_set(error, "no memory for its %zu triangles", triangles->triangle_count);
    state->flat = drop_flat(triangles);
    if (triangles->triangle_count == 0)
        return error_set(error, "none of its triangles has an area; a solid is a closed surface of them");
    if (!drop_unused(triangles) || !count_edges(triangles, state))
        return error_set(error, "no memory for its %zu triangles", triangles->triangle_count);
    centre(triangles, middle);
    state->inside_out = turn_outwards(triangles);
    return true;
}
