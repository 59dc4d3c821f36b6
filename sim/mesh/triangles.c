#include "sim/mesh/mesh_shape.h"

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

/* ---- edges ---- */

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

/* ---- discs ---- */

static const double ROUND = 2e-6; /* relative; more than the rounding error of single precision */

typedef struct AxisPosition {
    double along, off; /* along the axis; distance from the axis */
} AxisPosition;

static AxisPosition place_at(const Disc *disc, const double x[3])
{
    double p[3], along = 0, off2 = 0;
    for (int k = 0; k < 3; k++) {
        p[k] = x[k] - disc->middle[k];
        along += p[k] * disc->axis[k];
    }
    for (int k = 0; k < 3; k++)
        off2 += (p[k] - along * disc->axis[k]) * (p[k] - along * disc->axis[k]);
    return (AxisPosition){along, sqrt(off2)};
}

static AxisPosition corner_at(const Disc *disc, const Triangles *of, const uint32_t *item, uint32_t corner)
{
    const float *x = of->vertex[of->triangle[item[corner / 3]][corner % 3]];
    return place_at(disc, (double[]){x[0], x[1], x[2]});
}

static void mean_normal(const Triangles *of, const uint32_t *item, uint32_t count, float axis[3])
{
    double sum[3] = {0}, normal[3];
    for (uint32_t i = 0; i < count; i++) {
        triangle_normal(of, item[i], normal);
        for (int k = 0; k < 3; k++)
            sum[k] += normal[k];
    }
    const double length = sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
    for (int k = 0; k < 3; k++)
        axis[k] = length > 0 ? (float)(sum[k] / length) : 0;
}

/* Middle of the triangles' bounding box. */
static void middle_of(const Triangles *of, const uint32_t *item, uint32_t count, float middle[3])
{
    for (int k = 0; k < 3; k++) {
        float low = INFINITY, high = -INFINITY;
        for (uint32_t i = 0; i < 3 * count; i++) {
            const float x = of->vertex[of->triangle[item[i / 3]][i % 3]][k];
            low = x < low ? x : low;
            high = x > high ? x : high;
        }
        middle[k] = 0.5F * (low + high);
    }
}

/* Moves the disc along the axis for the least thickness. */
static void move_between(Disc *disc, const Triangles *of, const uint32_t *item, uint32_t count)
{
    double low = INFINITY, high = -INFINITY;
    for (uint32_t i = 0; i < 3 * count; i++) {
        const AxisPosition place = corner_at(disc, of, item, i);
        low = fmin(low, place.along);
        high = fmax(high, place.along);
    }
    for (int k = 0; k < 3; k++)
        disc->middle[k] += (float)(0.5 * (low + high) * disc->axis[k]);
}

Disc disc_around(const Triangles *of, const uint32_t *item, uint32_t count)
{
    Disc disc;
    double half = 0, radius = 0;
    mean_normal(of, item, count, disc.axis);
    middle_of(of, item, count, disc.middle);
    move_between(&disc, of, item, count);
    for (uint32_t i = 0; i < 3 * count; i++) {
        const AxisPosition place = corner_at(&disc, of, item, i);
        half = fmax(half, fabs(place.along));
        radius = fmax(radius, place.off);
    }
    const double wider = ROUND * (half + radius);
    disc.half = (float)(half + wider);
    disc.radius = (float)(radius + wider);
    return disc;
}

double disc_distance2(const Disc *disc, const double x[3])
{
    const AxisPosition place = place_at(disc, x);
    const double along = fabs(place.along) - disc->half, off = place.off - disc->radius;
    const double a = along > 0 ? along : 0, b = off > 0 ? off : 0;
    return (1 - ROUND) * (a * a + b * b);
}
