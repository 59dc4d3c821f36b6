#include "sim/points/points.h"

#include "sim/base/base.h"
#include "sim/points/walk.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { STEPS_LEAST = 4, STEPS_MOST = 16, A_RANGE = 32 };

static const double closest = 1e-5, rounding = 4e-7; /* as sim/points/sampling.c */

typedef struct NearWalk {
    const SurfaceRequest *request;
    Walkers walkers;
    Walk walk;
    int threads;
    size_t steps; /* per walker; consecutive points belong to different sets */
} NearWalk;

/* ---- starts of walkers ---- */

/* Moves eight walkers to the level by Newton's method; a walker without success gets NaN as position. */
SIMD_INLINE void seat_eight(const NearWalk *near, size_t w)
{
    float *const *column = near->walkers.place;
    LanePlace p = {f8_load(column[0] + w), f8_load(column[1] + w), f8_load(column[2] + w)};
    const LanePlace from = p;
    LaneSample s;
    const i8 found = lane_newton(&near->walk, near->request->field->kind->at[simd_wide()], &p, &s) &
                     lane_near(&near->walk, &p, &from);
    const f8 nowhere = f8_splat(NAN);
    f8_store(column[0] + w, f8_select(found, p.x, nowhere));
    f8_store(column[1] + w, f8_select(found, p.y, nowhere));
    f8_store(column[2] + w, f8_select(found, p.z, nowhere));
}

static void seat_range(void *context, size_t begin, size_t end)
{
    const NearWalk *near = context;
    for (size_t i = begin; i < end; i++)
        seat_eight(near, i * LANES);
}

static bool place_walkers(NearWalk *near, const SurfacePoint *seed, size_t seeds, Error *error)
{
    const size_t count = (seeds + LANES - 1) / LANES * LANES;
    float *column = malloc(3 * count * sizeof *column);
    near->walkers.place[0] = column;
    near->walkers.taken = calloc(count, sizeof *near->walkers.taken);
    if (!column || !near->walkers.taken)
        return error_set(error, "no memory for %zu walkers", count);
    near->walkers.count = count;
    for (size_t k = 0; k < 3; k++) {
        near->walkers.place[k] = column + k * count;
        for (size_t w = 0; w < count; w++)
            near->walkers.place[k][w] = w < seeds ? seed[w].position[k] : NAN;
    }
    return true;
}

/* Places walkers at random points by area on the triangles. */
static bool begin(NearWalk *near, const Polygons *polygons, size_t walkers, double area, Error *error)
{
    SurfaceRequest request = *near->request;
    SurfacePoints seeds = {0};
    SurfaceResult result;
    request.density = (double)walkers / area;
    request.sets = 1;
    request.points_most = 0;
    const bool ok = polygons_sample(polygons, &request, &seeds, &result, error) &&
                    place_walkers(near, seeds.point, seeds.count, error);
    surface_points_free(&seeds);
    if (ok)
        parallel_ranges(near->threads, near->walkers.count / LANES, A_RANGE, seat_range, near);
    return ok;
}

static void set_walk(NearWalk *near, const Polygons *polygons)
{
    const SurfaceRequest *request = near->request;
    double low[3], high[3], extent = 0, farthest = 0;
    polygons_bounds(polygons, low, high);
    for (int k = 0; k < 3; k++) {
        extent = fmax(extent, high[k] - low[k]);
        farthest = fmax(farthest, fmax(fabs(high[k]), fabs(low[k])));
    }
    const double step = request->step > 0 ? request->step : request->field->step;
    near->walk = (Walk){.field = request->field,
                        .walkers = &near->walkers,
                        .level = (float)request->level,
                        .step = (float)step,
                        .close = (float)fmax(closest * extent, rounding * farthest),
                        .reach = (float)(6 * step),
                        .no_bisection = true,
                        .key = philox_key(request->seed),
                        .count = (uint32_t)near->steps,
                        .surface = request->surface};
    for (int k = 0; k < 3; k++) {
        near->walk.low[k] = (float)request->field->low[k];
        near->walk.high[k] = (float)request->field->high[k];
    }
}

/* ---- points ---- */

static void walk_range(void *context, size_t begin_at, size_t end)
{
    const NearWalk *near = context;
    near->request->field->kind->walk[simd_wide()](&near->walk, begin_at * LANES, end * LANES);
}

/* Drops points of walkers without a start, and surplus points from rounding up. Returns the number of
   walkers with a start. */
static size_t drop_points(const NearWalk *near, size_t seeds, size_t wanted, SurfacePoints *points)
{
    SurfacePoint *point = points->point + points->count;
    size_t kept = 0, began = 0;
    for (size_t w = 0; w < seeds; w++) {
        const bool there = isfinite(near->walkers.place[0][w]);
        for (size_t k = 0; there && k < near->steps; k++)
            point[kept++] = point[w * near->steps + k];
        began += there;
    }
    const double all = (double)seeds * near->steps, share = (double)kept / all;
    points->count += (size_t)fmin((double)kept, rint((double)wanted * share));
    return began;
}

static bool walk_on(NearWalk *near, const Polygons *polygons, double area, SurfacePoints *points,
                    SurfaceResult *result, Error *error)
{
    const SurfaceRequest *request = near->request;
    const double asked = rint(request->density * request->sets * area);
    const size_t wanted = (size_t)fmin(asked, (double)request_points_most(request));
    const size_t seeds = (wanted + near->steps - 1) / near->steps;
    *result = (SurfaceResult){.area = area, .density = request->density, .reached = true};
    if (seeds == 0)
        return true;
    if (!begin(near, polygons, seeds, area, error) ||
        !surface_points_reserve(points, points->count + near->walkers.count * near->steps, error))
        return false;
    near->walk.out = points->point + points->count;
    parallel_ranges(near->threads, near->walkers.count / LANES, A_RANGE, walk_range, near);
    const size_t first = points->count, began = drop_points(near, seeds, wanted, points);
    result->points = points->count - first;
    result->stayed = seeds - began;
    result->density = request->density * (double)wanted / asked;
    result->reached = (double)wanted >= asked;
    return began > 0 ||
           error_set(error, "none of the field has the level %.6g near its triangles", request->level);
}

/* Number of steps per walker: fewer if steps are so short that points of a walker in several sets share a
   pixel, as in sampling.c. */
static size_t steps_of(const SurfaceRequest *request)
{
    const double steps = fmin(fmax(request->sets, STEPS_LEAST), STEPS_MOST), apart = 3;
    const double step = request->step > 0 ? request->step : request->field->step;
    const double part = request->pixel > 0 ? step / (apart * request->pixel) : 1;
    return (size_t)fmin(fmax(STEPS_MOST * part * part, 1), steps);
}

bool near_walk(const SurfaceRequest *request, const Polygons *polygons, SurfacePoints *points,
               SurfaceResult *result, Error *error)
{
    const double area = polygons_area(polygons);
    NearWalk near = {.request = request,
                     .steps = steps_of(request),
                     .threads = request->threads > 0 ? request->threads : parallel_processors()};
    *result = (SurfaceResult){0};
    if (!(area > 0) || !isfinite(area))
        return error_set(error, "there are no triangles near the level %.6g", request->level);
    set_walk(&near, polygons);
    const bool ok = walk_on(&near, polygons, area, points, result, error);
    free(near.walkers.place[0]);
    free(near.walkers.taken);
    return ok;
}
