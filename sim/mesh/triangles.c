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

/* Signed side of p relative to the line from a to b in the yz plane: equal but for the sign in both triangles
   of an edge. A point on the line counts as moved aside slightly in y, and less in z. */
static double side_of(const float a[3], const float b[3], const double p[3])
{
    const double ay = a[1] - p[1], az = a[2] - p[2], by = b[1] - p[1], bz = b[2] - p[2];
    const double twice = ay * bz - az * by;
    if (twice != 0)
        return twice;
    const double y = (double)a[2] - b[2], z = (double)b[1] - a[1];
    return y != 0 ? copysign(1e-300, y) : z != 0 ? copysign(1e-300, z) : 0;
}

static double ordered_side(const Triangles *of, uint32_t a, uint32_t b, const double p[3])
{
    return a < b ? side_of(of->vertex[a], of->vertex[b], p) : -side_of(of->vertex[b], of->vertex[a], p);
}

int triangle_crossing(const Triangles *of, size_t t, const double p[3], double *x)
{
    const uint32_t *c = of->triangle[t];
    const double s[3] = {ordered_side(of, c[1], c[2], p), ordered_side(of, c[2], c[0], p),
                         ordered_side(of, c[0], c[1], p)};
    const bool in = s[0] > 0 && s[1] > 0 && s[2] > 0, out = s[0] < 0 && s[1] < 0 && s[2] < 0;
    if (!in && !out)
        return 0;
    const double sum = s[0] + s[1] + s[2];
    *x = (s[0] * of->vertex[c[0]][0] + s[1] * of->vertex[c[1]][0] + s[2] * of->vertex[c[2]][0]) / sum;
    return in ? 1 : -1;
}

void triangle_slice(const Triangles *of, size_t t, double z, double margin, double *low, double *high)
{
    *low = INFINITY, *high = -INFINITY;
    for (int c = 0; c < 3; c++) {
        const float *a = of->vertex[of->triangle[t][c]], *b = of->vertex[of->triangle[t][(c + 1) % 3]];
        const double from = a[2] - z, to = b[2] - z, way = to - from;
        const double ends[2] = {way != 0 ? fmin(fmax((-margin - from) / way, 0), 1) : 0,
                                way != 0 ? fmin(fmax((margin - from) / way, 0), 1) : 1};
        if (fmax(from, to) < -margin || fmin(from, to) > margin)
            continue;
        for (int e = 0; e < 2; e++) {
            const double y = a[1] + ends[e] * ((double)b[1] - a[1]);
            *low = fmin(*low, y - margin);
            *high = fmax(*high, y + margin);
        }
    }
}
