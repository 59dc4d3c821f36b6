#include "sim/points/points.h"

#include "sim/base/base.h"
#include "sim/points/walk.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CANDIDATES = COUNTING_CANDIDATES, ENOUGH = 40, KNOWN_MOST = 16384, ATTEMPTS = 8, A_RANGE = 16384 };

static const double widest = 0.05;   /* radius, as a share of the surface's extent */
static const double parallel = 0.8;  /* least cosine between normals in a sphere */
static const double flattest = 0.35; /* of the radius: greatest distance from the tangent plane */

/* Known points of the surface: positions and unit normals. */
typedef struct Known {
    size_t count;
    const float (*place)[3];
    float (*normal)[3];
} Known;

static void normal_at(const LevelField *field, const float place[3], float normal[3])
{
    LevelSample s;
    level_at(field, (double[3]){(double)place[0], (double)place[1], (double)place[2]}, &s);
    const float *g = s.gradient, length = sqrtf(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    for (int k = 0; k < 3; k++)
        normal[k] = g[k] / length;
}

static float dot(const float a[3], const float b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* True if the known points in the sphere about c form a flat piece. */
static bool fair(const LineSearch *search, const Known *known, const float c[3], double radius)
{
    float normal[3];
    normal_at(search->field, c, normal);
    for (int k = 0; k < 3; k++)
        if ((double)c[k] - search->low[k] < radius || search->high[k] - (double)c[k] < radius)
            return false;
    for (size_t j = 0; j < known->count; j++) {
        const float d[3] = {known->place[j][0] - c[0], known->place[j][1] - c[1], known->place[j][2] - c[2]};
        if ((double)dot(d, d) < radius * radius && (!((double)dot(normal, known->normal[j]) >= parallel) ||
                                                    (double)fabsf(dot(d, normal)) > flattest * radius))
            return false;
    }
    return true;
}

static size_t draw(const LineSearch *search, uint32_t index, size_t count)
{
    uint32_t word[4] = {index, 0, 0, PHILOX_SPHERES};
    philox(search->key, word);
    return (size_t)((uint64_t)word[0] * count >> 32);
}

static void choose(Counting *counting, const LineSearch *search, const Crossings *crossings, size_t walkers,
                   const Known *known, double extent)
{
    const size_t first = crossings->count >= walkers + CANDIDATES ? walkers : 0,
                 among = crossings->count - first;
    double radius = widest * extent;
    for (int attempt = 0; attempt <= ATTEMPTS; attempt++, radius /= 1.5) {
        const bool any = attempt == ATTEMPTS; /* no flat piece anywhere: as in the paper */
        counting->count = 0;
        counting->radius = (float)radius;
        for (uint32_t k = 0; k < CANDIDATES && counting->count < COUNTING_SPHERES; k++) {
            const float *place = crossings->place[first + draw(search, k, among)];
            if (any || fair(search, known, place, radius))
                memcpy(counting->centre[counting->count++], place, sizeof counting->centre[0]);
        }
        if (counting->count >= ENOUGH)
            return;
    }
}

/* ---- spheres by cell ---- */

static int cell_along(const Counting *counting, int axis, double x)
{
    const double at = (x - counting->low[axis]) / counting->cell[axis];
    return at > 0 ? at < COUNTING_CELLS ? (int)at : COUNTING_CELLS - 1 : 0;
}

/* Visits each cell touched by a sphere: counts there, or with `write` stores the sphere. */
static void reach(Counting *counting, int sphere, bool write)
{
    int from[3], to[3];
    for (int k = 0; k < 3; k++) {
        from[k] = cell_along(counting, k, counting->centre[sphere][k] - 1.001 * counting->radius);
        to[k] = cell_along(counting, k, counting->centre[sphere][k] + 1.001 * counting->radius);
    }
    for (int z = from[2]; z <= to[2]; z++)
        for (int y = from[1]; y <= to[1]; y++)
            for (int x = from[0]; x <= to[0]; x++) {
                uint32_t *begin = &counting->begin[x + COUNTING_CELLS * (y + COUNTING_CELLS * z)];
                if (write)
                    counting->member[*begin] = (uint8_t)sphere;
                ++*begin;
            }
}

static bool sort(Counting *counting)
{
    const size_t cells = sizeof counting->begin / sizeof counting->begin[0] - 1;
    for (int i = 0; i < counting->count; i++)
        reach(counting, i, false);
    uint32_t total = 0;
    for (size_t c = 0; c <= cells; c++) {
        const uint32_t here = counting->begin[c];
        counting->begin[c] = total;
        total += here;
    }
    counting->member = malloc(total + 1);
    if (!counting->member)
        return false;
    for (int i = 0; i < counting->count; i++)
        reach(counting, i, true);
    memmove(counting->begin + 1, counting->begin, cells * sizeof counting->begin[0]);
    counting->begin[0] = 0;
    return true;
}

bool counting_begin(Counting *counting, const LineSearch *search, const Crossings *crossings, size_t walkers,
                    Error *error)
{
    memset(counting, 0, sizeof *counting);
    Known known = {.count = crossings->count < KNOWN_MOST ? crossings->count : KNOWN_MOST,
                   .place = (const float(*)[3])crossings->place};
    known.normal = malloc(known.count * sizeof *known.normal);
    if (!known.normal)
        return error_set(error, "no memory for counting spheres");
    double extent = 0;
    for (int k = 0; k < 3; k++) {
        const double side = crossings->high[k] - crossings->low[k];
        extent = fmax(extent, side);
        counting->low[k] = crossings->low[k];
        counting->cell[k] = fmax(side, 1e-30) / COUNTING_CELLS;
    }
    for (size_t i = 0; i < known.count; i++)
        normal_at(search->field, known.place[i], known.normal[i]);
    choose(counting, search, crossings, walkers, &known, extent);
    free(known.normal);
    return sort(counting) || error_set(error, "no memory for counting spheres");
}

/* ---- the count ---- */

typedef struct Count {
    Counting *counting;
    const SurfacePoint *point;
} Count;

static void count_range(void *context, size_t begin, size_t end)
{
    const Count *count = context;
    Counting *counting = count->counting;
    const float square = counting->radius * counting->radius;
    uint32_t inside[COUNTING_SPHERES] = {0};
    for (size_t i = begin; i < end; i++) {
        const float *p = count->point[i].position;
        const int cell =
            cell_along(counting, 0, p[0]) +
            COUNTING_CELLS * (cell_along(counting, 1, p[1]) + COUNTING_CELLS * cell_along(counting, 2, p[2]));
        for (uint32_t m = counting->begin[cell]; m < counting->begin[cell + 1]; m++) {
            const float *c = counting->centre[counting->member[m]];
            const float d[3] = {p[0] - c[0], p[1] - c[1], p[2] - c[2]};
            inside[counting->member[m]] += dot(d, d) < square;
        }
    }
    for (int k = 0; k < counting->count; k++) /* integers: independent of order */
        __atomic_fetch_add(&counting->inside[k], inside[k], __ATOMIC_RELAXED);
}

void counting_add(Counting *counting, const SurfacePoint *point, size_t count, int threads)
{
    Count context = {counting, point};
    parallel_ranges(threads, count, A_RANGE, count_range, &context);
}

double counting_mean(const Counting *counting)
{
    double sum = 0;
    for (int k = 0; k < counting->count; k++)
        sum += counting->inside[k];
    return sum / counting->count;
}

void counting_end(Counting *counting)
{
    free(counting->member);
    counting->member = NULL;
}
