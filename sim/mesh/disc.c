#include "sim/mesh/disc.h"

#include <math.h>

static const double ROUND = 2e-6; /* relative; more than the rounding error of single precision */

typedef struct Place {
    double along, off; /* along the axis; distance from the axis */
} Place;

static Place place_at(const Disc *disc, const double x[3])
{
    double p[3], along = 0, off2 = 0;
    for (int k = 0; k < 3; k++) {
        p[k] = x[k] - disc->middle[k];
        along += p[k] * disc->axis[k];
    }
    for (int k = 0; k < 3; k++)
        off2 += (p[k] - along * disc->axis[k]) * (p[k] - along * disc->axis[k]);
    return (Place){along, sqrt(off2)};
}

static Place corner_at(const Disc *disc, const Triangles *of, const uint32_t *item, uint32_t corner)
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
        const Place place = corner_at(disc, of, item, i);
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
        const Place place = corner_at(&disc, of, item, i);
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
    const Place place = place_at(disc, x);
    const double along = fabs(place.along) - disc->half, off = place.off - disc->radius;
    const double a = along > 0 ? along : 0, b = off > 0 ? off : 0;
    return (1 - ROUND) * (a * a + b * b);
}
