#include "sim/mesh/edges.h"

#include <stdlib.h>

static void ends_of(const Triangles *triangles, size_t side, uint32_t *from, uint32_t *to)
{
    *from = triangles->triangle[side / 3][side % 3];
    *to = triangles->triangle[side / 3][(side + 1) % 3];
}

bool side_forward(const Triangles *triangles, uint32_t side)
{
    uint32_t from, to;
    ends_of(triangles, side, &from, &to);
    return from < to;
}

static int ascending(const void *a, const void *b)
{
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

/* Sorts the sides by the lesser vertex, then by the greater. `key`: greater vertex << 32 | side. `begin`: on
   return, the end of each vertex's sides in `key`. */
static void sort_sides(const Triangles *triangles, size_t *begin, uint64_t *key)
{
    const size_t sides = 3 * triangles->triangle_count;
    uint32_t from, to;
    for (size_t i = 0; i < sides; i++) {
        ends_of(triangles, i, &from, &to);
        begin[(from < to ? from : to) + 1]++;
    }
    for (size_t v = 0; v < triangles->vertex_count; v++)
        begin[v + 1] += begin[v];
    for (size_t i = 0; i < sides; i++) {
        ends_of(triangles, i, &from, &to);
        key[begin[from < to ? from : to]++] = (uint64_t)(from < to ? to : from) << 32 | i;
    }
    for (size_t v = 0, at = 0; v < triangles->vertex_count; at = begin[v++])
        qsort(key + at, begin[v] - at, sizeof *key, ascending);
}

static void group(const Triangles *triangles, const size_t *begin, const uint64_t *key, Edges *edges)
{
    for (size_t v = 0, i = 0; v < triangles->vertex_count; v++)
        for (size_t first = i; i < begin[v]; i++) {
            if (i == first || key[i] >> 32 != key[i - 1] >> 32)
                edges->first[edges->count++] = (uint32_t)i;
            edges->side[i] = (uint32_t)key[i];
        }
    edges->first[edges->count] = (uint32_t)(3 * triangles->triangle_count);
}

bool edges_make(Edges *edges, const Triangles *triangles)
{
    const size_t sides = 3 * triangles->triangle_count;
    size_t *begin = calloc(triangles->vertex_count + 2, sizeof *begin);
    uint64_t *key = malloc((sides + 1) * sizeof *key);
    *edges = (Edges){.first = malloc((sides + 1) * sizeof *edges->first),
                     .side = malloc((sides + 1) * sizeof *edges->side)};
    const bool ok = begin && key && edges->first && edges->side;
    if (ok) {
        sort_sides(triangles, begin, key);
        group(triangles, begin, key, edges);
    } else {
        edges_free(edges);
    }
    free(begin);
    free(key);
    return ok;
}

void edges_free(Edges *edges)
{
    free(edges->first);
    free(edges->side);
    *edges = (Edges){0};
}
