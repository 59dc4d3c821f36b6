#include "sim/points/points.h"

#include "sim/base/base.h"
#include "sim/points/walk.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ROUND = 16, A_RANGE = 256, WALKERS_LEAST = 4096, WALKERS_MOST = 1 << 20, STEPS_EACH = 16 };

static const double closest = 1e-5;  /* of the surface's extent: tolerance for points on the surface */
static const double rounding = 4e-7; /* of the coordinates: precision of floats */
static const double widest = 0.05;   /* of the extent: longest step for a surface that is small in its
                                        field */
static const double differs = 0.05;  /* of n: beyond this difference, the area is more accurate than the
                                        spheres */
static const double doubted = 0.1;   /* and beyond this difference, not by chance: the result notes it */

/* ---- the walk ---- */

typedef struct Sampling {
    const SurfaceRequest *request;
    LineSearch search;
    Crossings crossings;
    double expected; /* points, from the area */
    Walkers walkers;
    Walk walk;
    Counting counting;
    WalkLanes run;
} Sampling;

static double step_of(const Sampling *sampling)
{
    const SurfaceRequest *request = sampling->request;
    const Crossings *crossings = &sampling->crossings;
    double extent = 0;
    for (int k = 0; k < 3; k++)
        extent = fmax(extent, crossings->high[k] - crossings->low[k]);
    return request->step > 0 ? request->step : fmin(request->field->step, widest * extent);
}

/* A walker returns to a pixel after k steps, s pixels each, with probability 1 / (2 pi k s^2). */
static double steps_each(const SurfaceRequest *request, double step)
{
    static const double FREE = 3;
    if (!(request->pixel > 0))
        return STEPS_EACH;
    const double part = step / (FREE * request->pixel);
    return fmin(fmax(STEPS_EACH * part * part, 1), STEPS_EACH);
}

static size_t walkers_for(const SurfaceRequest *request, double expected, double step)
{
    const double wanted = request->walkers > 0
                              ? request->walkers
                              : fmin(fmax(expected / steps_each(request, step), WALKERS_LEAST), WALKERS_MOST);
    return ((size_t)wanted + LANES - 1) / LANES * LANES;
}

/* Starts walkers at crossings of lines with the surface; with too few crossings, several walkers per
   crossing. */
static bool place_walkers(Walkers *walkers, const Crossings *crossings, size_t count, Error *error)
{
    float *column = malloc(3 * count * sizeof *column);
    walkers->place[0] = column;
    walkers->taken = calloc(count, sizeof *walkers->taken);
    if (!column || !walkers->taken || !crossings->place)
        return error_set(error, "no memory for %zu walkers", count);
    walkers->count = count;
    for (size_t k = 0; k < 3; k++) {
        walkers->place[k] = column + k * count;
        for (size_t w = 0, from = 0; w < count; w++, from = from + 1 < crossings->count ? from + 1 : 0)
            walkers->place[k][w] = crossings->place[from][k];
    }
    return true;
}

static void set_walk(Sampling *sampling)
{
    const SurfaceRequest *request = sampling->request;
    const Crossings *crossings = &sampling->crossings;
    double extent = 0, farthest = 0;
    for (int k = 0; k < 3; k++) {
        extent = fmax(extent, crossings->high[k] - crossings->low[k]);
        farthest = fmax(farthest, fmax(fabs(crossings->high[k]), fabs(crossings->low[k])));
    }
    const double step = step_of(sampling);
    sampling->walk = (Walk){.field = request->field,
                            .walkers = &sampling->walkers,
                            .level = (float)request->level,
                            .step = (float)step,
                            .close = (float)fmax(closest * extent, rounding * farthest),
                            .reach = (float)(6 * step),
                            .key = sampling->search.key,
                            .surface = request->surface};
    for (int k = 0; k < 3; k++) {
        sampling->walk.low[k] = (float)sampling->search.low[k];
        sampling->walk.high[k] = (float)sampling->search.high[k];
    }
    sampling->run = request->field->kind->walk[simd_wide()];
}

static void run_range(void *context, size_t begin, size_t end)
{
    const Sampling *sampling = context;
    sampling->run(&sampling->walk, begin * LANES, end * LANES);
}

static void run_steps(Sampling *sampling, size_t steps, SurfacePoint *out)
{
    sampling->walk.out = out;
    sampling->walk.count = (uint32_t)steps;
    parallel_ranges(sampling->search.threads, sampling->walkers.count / LANES, A_RANGE / LANES, run_range,
                    sampling);
    sampling->walk.first += (uint32_t)steps;
}

/* Runs the next steps; appends the points after the `made` points of the call and counts in the spheres. */
static bool walk_some(Sampling *sampling, size_t steps, SurfacePoints *points, size_t made, Error *error)
{
    const SurfaceDevice *device = sampling->request->device;
    const size_t count = steps * sampling->walkers.count, first = points->count + made;
    if (device) {
        sampling->walk.count = (uint32_t)steps;
        const bool ok = device->steps(device->own, &sampling->walk, true, &sampling->counting, error);
        sampling->walk.first += (uint32_t)steps;
        return ok;
    }
    if (!surface_points_reserve(points, first + count, error))
        return false;
    run_steps(sampling, steps, points->point + first);
    counting_add(&sampling->counting, points->point + first, count, sampling->search.threads);
    return true;
}

static bool burn_in(Sampling *sampling, Error *error)
{
    const SurfaceDevice *device = sampling->request->device;
    const int steps = sampling->request->burn_in;
    if (steps > 0 && !device)
        run_steps(sampling, (size_t)steps, NULL);
    if (steps <= 0 || !device)
        return true;
    sampling->walk.count = (uint32_t)steps;
    const bool ok = device->steps(device->own, &sampling->walk, false, &sampling->counting, error);
    sampling->walk.first += (uint32_t)steps;
    return ok;
}

/* Estimated number of steps still needed by all walkers, at most a round; from the area before the first
   count. */
static size_t steps_left(const Sampling *sampling, double wanted, double so_far, size_t done)
{
    const double left = done == 0     ? sampling->expected / (double)sampling->walkers.count
                        : so_far <= 0 ? ROUND
                                      : (wanted - so_far) / (so_far / (double)done);
    return (size_t)fmin(fmax(ceil(left), 1), ROUND);
}

static size_t taken(const Sampling *sampling)
{
    const SurfaceDevice *device = sampling->request->device;
    size_t sum = device ? device->taken(device->own) : 0;
    for (size_t w = 0; w < sampling->walkers.count; w++)
        sum += sampling->walkers.taken[w];
    return sum;
}

/* Keeps the first `kept` points of the walk at the request's destination. */
static bool keep_points(const SurfaceRequest *request, size_t kept, SurfacePoints *points, Error *error)
{
    const SurfaceDevice *device = request->device;
    SurfacePoint *to = NULL;
    if (device && !request->stay) {
        if (!surface_points_reserve(points, points->count + kept, error))
            return false;
        to = points->point + points->count;
    }
    if (device && ((request->colour && !device->colour(device->own, request->colour, error)) ||
                   !device->points(device->own, kept, to, error)))
        return false;
    points->count += device && request->stay ? 0 : kept;
    return true;
}

/* n of `made` points. The spheres are wrong by factors in three cases. A finely folded surface has several
   sheets in a sphere; the chosen spheres are those with few points, or walkers begin at the centres of
   spheres for lack of further crossings. The area from lines is independent of these errors, and accurate
   to some hundredths. */
static double count_in_circle(const Sampling *sampling, double great_circle, size_t made)
{
    const double n = counting_mean(&sampling->counting);
    const double by_area = (double)made / sampling->crossings.area * great_circle;
    return fabs(n - by_area) > differs * by_area ? by_area : n;
}

static void note_walk(const Sampling *sampling, double great_circle, size_t made, SurfaceResult *result)
{
    const double by_area = (double)made / sampling->crossings.area * great_circle;
    const double times = counting_mean(&sampling->counting) / by_area;
    const size_t steps = sampling->walk.first * sampling->walkers.count;
    if (fabs(times - 1) > doubted)
        result_note(
            result,
            "its points are counted by its area: spheres on it hold %.2g times as many, as where it is "
            "folded finely or small in its bounds",
            times);
    if (2 * result->stayed > steps)
        result_note(result, "%.0f %% of all steps found no way along it: take a smaller step",
                    100 * (double)result->stayed / (double)steps);
}

/* Rounds of steps, until the counting spheres hold enough points or the limit is reached. */
static bool walk_on(Sampling *sampling, SurfacePoints *points, SurfaceResult *result, Error *error)
{
    const SurfaceRequest *request = sampling->request;
    Counting *counting = &sampling->counting;
    const double great_circle = M_PI * (double)counting->radius * (double)counting->radius;
    const double wanted = request->density * request->sets * great_circle;
    const size_t each = sampling->walkers.count, most = request_points_most(request);
    size_t made = 0, steps = 0;
    double n = 0;
    while (n < wanted && made < most) {
        const size_t more = steps_left(sampling, wanted, n, steps);
        if (!walk_some(sampling, more, points, made, error))
            return false;
        made += more * each;
        steps += more;
        n = count_in_circle(sampling, great_circle, made);
    }
    const double right = n > wanted ? rint((double)made * wanted / n) : (double)made;
    const double kept = fmin(right, (double)most);
    const bool reached = n >= wanted && kept == right && kept > 0;
    n *= kept / (double)made;
    *result = (SurfaceResult){.points = (size_t)kept,
                              .area = sampling->crossings.area,
                              .density = n / great_circle / request->sets,
                              .reached = reached,
                              .counted = n,
                              .great_circle = great_circle,
                              .spheres = counting->count,
                              .stayed = sampling->walk.first * each - taken(sampling)};
    note_walk(sampling, great_circle, made, result);
    return keep_points(request, (size_t)kept, points, error);
}

static bool walk_begin(Sampling *sampling, Error *error)
{
    const SurfaceRequest *request = sampling->request;
    if (!lines_cross(&sampling->search, &sampling->crossings, error))
        return false;
    sampling->expected = fmin(request->density * request->sets * sampling->crossings.area,
                              (double)request_points_most(request));
    const size_t count = walkers_for(request, sampling->expected, step_of(sampling));
    if (!lines_more(&sampling->search, count + 2 * COUNTING_CANDIDATES, &sampling->crossings, error) ||
        !place_walkers(&sampling->walkers, &sampling->crossings, count, error) ||
        !counting_begin(&sampling->counting, &sampling->search, &sampling->crossings, count, error))
        return false;
    set_walk(sampling);
    const SurfaceDevice *device = request->device;
    return !device || device->begin(device->own, &sampling->walk, &sampling->counting,
                                    (size_t)sampling->expected, error);
}

static bool walk_surface(const SurfaceRequest *request, const LineSearch *search, SurfacePoints *points,
                         SurfaceResult *result, Error *error)
{
    Sampling sampling = {.request = request, .search = *search};
    const bool ok = walk_begin(&sampling, error) && burn_in(&sampling, error) &&
                    walk_on(&sampling, points, result, error);
    if (request->device)
        request->device->end(request->device->own);
    free(sampling.walkers.place[0]);
    free(sampling.walkers.taken);
    counting_end(&sampling.counting);
    crossings_free(&sampling.crossings);
    return ok;
}

/* ---- colours ---- */

typedef struct Colouring {
    const LevelField *colour;
    SurfacePoint *point;
} Colouring;

static void colour_range(void *context, size_t begin, size_t end)
{
    const Colouring *colouring = context;
    for (size_t i = begin; i < end; i += LANES) {
        const size_t count = end - i < LANES ? end - i : LANES;
        LanePlace p;
        LaneSample s;
        for (size_t lane = 0; lane < LANES; lane++) {
            const float *place = colouring->point[i + (lane < count ? lane : 0)].position;
            p.x[lane] = place[0];
            p.y[lane] = place[1];
            p.z[lane] = place[2];
        }
        level_lanes(colouring->colour, &p, &s);
        for (size_t lane = 0; lane < count; lane++)
            colouring->point[i + lane].value = s.value[lane];
    }
}

/* ---- sampling ---- */

static const char *const names[] = {"walk", "triangles", NULL};

const char *surface_sampler_name(SurfaceSampler sampler)
{
    return sampler < SURFACE_SAMPLERS ? names[sampler] : NULL;
}

static void say_lack(const SurfaceRequest *request, SurfaceResult *result)
{
    if (result->points == 0)
        snprintf(result->lack, sizeof result->lack,
                 "surface %u has no point: %.3g a m2 and set are less than one in all", request->surface,
                 request->density);
    else
        snprintf(
            result->lack, sizeof result->lack,
            "surface %u has %.3g of %.3g points a m2 and set: %zu points are the most; take fewer sets, less "
            "opacity or a smaller picture",
            request->surface, result->density, request->density, request_points_most(request));
}

bool surface_sample(const SurfaceRequest *request, SurfacePoints *points, SurfaceResult *result, Error *error)
{
    const size_t first = points->count;
    LineSearch search;
    *result = (SurfaceResult){0};
    if (!request_check(request, error))
        return false;
    request_bounds(request, search.low, search.high);
    search.field = request->field;
    search.level = request->level;
    search.key = philox_key(request->seed);
    search.threads = request->threads > 0 ? request->threads : parallel_processors();
    const bool ok = request->sampler == SURFACE_TRIANGLES
                        ? triangles_sample(request, &search, points, result, error)
                        : walk_surface(request, &search, points, result, error);
    if (!ok) {
        points->count = first;
        return false;
    }
    if (!result->reached)
        say_lack(request, result);
    if (request->colour && points->count > first && !request->device) {
        Colouring colouring = {request->colour, points->point + first};
        parallel_ranges(search.threads, points->count - first, 16 * A_RANGE, colour_range, &colouring);
    }
    return true;
}
