#include "render/plane/plane.h"

#include <math.h>
#include <string.h>

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void scale_to_one(double v[3])
{
    const double length = sqrt(dot(v, v));
    for (int k = 0; k < 3; k++)
        v[k] /= length;
}

static void make_axes(const double normal[3], Plane *plane)
{
    double *n = plane->normal, *up = plane->up, *along = plane->along;
    memcpy(n, normal, sizeof plane->normal);
    scale_to_one(n);
    const bool level = fabs(n[1]) > 0.999;
    const double toward[3] = {0, level ? 0 : 1, level ? -1 : 0}, away = dot(toward, n);
    for (int k = 0; k < 3; k++)
        up[k] = toward[k] - away * n[k];
    scale_to_one(up);
    along[0] = up[1] * n[2] - up[2] * n[1];
    along[1] = up[2] * n[0] - up[0] * n[2];
    along[2] = up[0] * n[1] - up[1] * n[0];
}

typedef struct Extent {
    double low[2], high[2]; /* relative to the point, m */
} Extent;

static void add_point(const Plane *plane, const double from_point[3], Extent *extent)
{
    const double at[2] = {dot(from_point, plane->along), dot(from_point, plane->up)};
    for (int k = 0; k < 2; k++) {
        extent->low[k] = fmin(extent->low[k], at[k]);
        extent->high[k] = fmax(extent->high[k], at[k]);
    }
}

/* Corner `number` of the box, relative to the point. */
static void box_corner(const double size[3], const double point[3], int number, double out[3])
{
    out[0] = size[0] * ((number & 1) ? 0.5 : -0.5) - point[0];
    out[1] = ((number & 2) ? size[1] : 0) - point[1];
    out[2] = size[2] * ((number & 4) ? 0.5 : -0.5) - point[2];
}

/* Adds the point where the plane cuts the edge between two corners. */
static void add_edge(const Plane *plane, const double a[3], const double b[3], Extent *extent)
{
    const double above = dot(a, plane->normal), below = dot(b, plane->normal);
    if (above * below > 0)
        return;
    if (above == below) { /* the edge lies on the plane */
        add_point(plane, a, extent);
        add_point(plane, b, extent);
        return;
    }
    const double share = above / (above - below);
    double cut[3];
    for (int k = 0; k < 3; k++)
        cut[k] = a[k] + share * (b[k] - a[k]);
    add_point(plane, cut, extent);
}

bool plane_make(const double box_size[3], const double point[3], const double normal[3], Plane *plane)
{
    Extent extent = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    make_axes(normal, plane);
    for (int corner = 0; corner < 8; corner++)
        for (int axis = 1; axis < 8; axis *= 2)
            if (!(corner & axis)) {
                double a[3], b[3];
                box_corner(box_size, point, corner, a);
                box_corner(box_size, point, corner | axis, b);
                add_edge(plane, a, b, &extent);
            }
    const bool cuts = extent.high[0] > extent.low[0] && extent.high[1] > extent.low[1];
    for (int k = 0; k < 3; k++)
        plane->corner[k] =
            point[k] + (cuts ? extent.low[0] * plane->along[k] + extent.low[1] * plane->up[k] : 0);
    for (int k = 0; k < 2; k++)
        plane->size[k] = cuts ? extent.high[k] - extent.low[k] : 0;
    return cuts;
}

void plane_sample(const Plane *plane, const int samples[2], int column, int row, double at[3])
{
    const double x = plane->size[0] * (column + 0.5) / samples[0],
                 y = plane->size[1] * (row + 0.5) / samples[1];
    for (int k = 0; k < 3; k++)
        at[k] = plane->corner[k] + x * plane->along[k] + y * plane->up[k];
}
