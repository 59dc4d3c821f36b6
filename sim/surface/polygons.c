#include "sim/surface/polygons.h"

#include <math.h>
#include <stdlib.h>

bool polygons_reserve(Polygons *polygons, size_t vertices, size_t triangles, Error *error)
{
    polygons_free(polygons);
    polygons->place = malloc((vertices + 1) * sizeof *polygons->place);
    polygons->normal = malloc((vertices + 1) * sizeof *polygons->normal);
    polygons->corner = malloc((triangles + 1) * sizeof *polygons->corner);
    if (!polygons->place || !polygons->normal || !polygons->corner) {
        polygons_free(polygons);
        return error_set(error, "no memory for a mesh of %zu triangles", triangles);
    }
    polygons->vertex_count = vertices;
    polygons->triangle_count = triangles;
    return true;
}

void polygons_free(Polygons *polygons)
{
    free(polygons->place);
    free(polygons->normal);
    free(polygons->corner);
    *polygons = (Polygons){0};
}

void polygons_bounds(const Polygons *polygons, double low[3], double high[3])
{
    for (int k = 0; k < 3; k++) {
        low[k] = INFINITY;
        high[k] = -INFINITY;
        for (size_t i = 0; i < polygons->vertex_count; i++) {
            low[k] = fmin(low[k], (double)polygons->place[i][k]);
            high[k] = fmax(high[k], (double)polygons->place[i][k]);
        }
    }
}
