#include "sim/mesh/crossing.h"

#include <math.h>

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
