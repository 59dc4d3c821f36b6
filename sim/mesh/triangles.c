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

double triangle_volume6(const Triangles *triangles, size_t t)
{
    const float *corner = triangles->vertex[triangles->triangle[t][0]];
    double normal[3];
    triangle_normal(triangles, t, normal);
    return corner[0] * normal[0] + corner[1] * normal[1] + corner[2] * normal[2];
}

void triangle_turn(Triangles *triangles, size_t t)
{
    uint32_t *corner = triangles->triangle[t], second = corner[1];
    corner[1] = corner[2];
    corner[2] = second;
}

double triangles_volume(const Triangles *triangles)
{
    double sum = 0;
    for (size_t t = 0; t < triangles->triangle_count; t++)
        sum += triangle_volume6(triangles, t);
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
