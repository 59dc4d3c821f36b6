/* What tests of samplers share: sums over patches of equal area, and requests. */
#ifndef SLOSH_TESTS_SURFACE_FIXTURE_H
#define SLOSH_TESTS_SURFACE_FIXTURE_H

#include "tests/tolerance.h"

#include "sim/points/points.h"

#include <stdlib.h>
#include <string.h>

static const double origin[3] = {0, 0, 0};

enum { RING_MM = 350, TUBE_MM = 150 }; /* a torus of width 1 m */

/* side x side patches of equal area on a sphere of radius 0.5 m: azimuth and height (Archimedes). */
static inline int sphere_patch(const float p[3], int side)
{
    const int a = (int)((atan2((double)p[2], (double)p[0]) / (2 * M_PI) + 0.5) * side);
    const int b = (int)(((double)p[1] + 0.5) * side);
    return (a < side ? a : side - 1) * side + (b < 0 ? 0 : b < side ? b : side - 1);
}

/* And on the torus: its area grows round the tube as ring angle + tube sin(angle). */
static inline int torus_patch(const float p[3], int side)
{
    const double ring = 1e-3 * RING_MM, tube = 1e-3 * TUBE_MM;
    const double angle = atan2((double)p[1], hypot((double)p[0], (double)p[2]) - ring);
    const int a = (int)((atan2((double)p[2], (double)p[0]) / (2 * M_PI) + 0.5) * side);
    const int b = (int)(((ring * angle + tube * sin(angle)) / (2 * M_PI * ring) + 0.5) * side);
    return (a < side ? a : side - 1) * side + (b < 0 ? 0 : b < side ? b : side - 1);
}

typedef int Patch(const float p[3], int side);

/* Of counts over equal patches. */
typedef struct Evenness {
    double chi_square, worst; /* the greatest deviation, of the mean */
} Evenness;

static inline Evenness evenness(const SurfacePoint *point, size_t count, size_t stride, Patch *patch,
                                int side)
{
    const int patches = side * side;
    double *found = calloc((size_t)patches, sizeof *found), sum = 0;
    Evenness even = {0};
    assert_non_null(found);
    for (size_t i = 0; i < count; i += stride, sum++)
        found[patch(point[i].position, side)]++;
    for (int k = 0; k < patches; k++) {
        const double mean = sum / patches, off = found[k] - mean;
        even.chi_square += off * off / mean;
        even.worst = fmax(even.worst, fabs(off) / mean);
    }
    free(found);
    return even;
}

/* What a chi-square of so many degrees of freedom exceeds in 1 % of all cases, by the normal approximation.
 */
static inline double chi_square_bound(int degrees)
{
    return degrees + 2.326 * sqrt(2.0 * degrees);
}

/* So many points on an area, in 20 sets. */
static inline SurfaceRequest request_for(const LevelField *field, double area, double points)
{
    return (SurfaceRequest){
        .field = field, .density = points / area / 20, .sets = 20, .seed = 7, .threads = 2};
}

static inline SurfaceResult sample(const SurfaceRequest *request, SurfacePoints *points)
{
    SurfaceResult result;
    Error error = {{0}};
    if (!surface_sample(request, points, &result, &error))
        fail_msg("%s", error.message);
    return result;
}

/* The message of a request that must fail. */
static inline const char *refusal(const SurfaceRequest *request, Error *error)
{
    SurfacePoints points = {0};
    SurfaceResult result;
    *error = (Error){{0}};
    assert_false(surface_sample(request, &points, &result, error));
    assert_int_equal(points.count, 0);
    surface_points_free(&points);
    return error->message;
}

#endif
