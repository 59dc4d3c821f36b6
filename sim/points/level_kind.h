/* What the samplers of points share: functions of a kind of field, and crossings of a level by lines. */
#ifndef SIM_POINTS_LEVEL_KIND_H
#define SIM_POINTS_LEVEL_KIND_H

#include "sim/points/lanes.h"
#include "sim/points/points.h"

/* A kind of field: for the samplers, and for adding kinds (README.md). */

typedef struct LanePlace { /* m, the box's frame */
    Lanes x, y, z;
} LanePlace;

typedef struct LaneSample { /* as LevelSample */
    Lanes value, x, y, z, bend;
} LaneSample;

/* The field at eight positions. Beyond the field's bounds any finite continuation will do. */
typedef void (*LaneField)(const LevelField *field, const LanePlace *place, LaneSample *out);

typedef struct Walk Walk;
typedef void (*WalkLanes)(const Walk *walk, size_t begin, size_t end);

/* Data of a field for shaders/surface/NAME.glsl besides the position. */
typedef struct LevelParts {
    float number[16];
    struct {
        const void *data; /* NULL: none */
        size_t bytes;
    } array[2];
} LevelParts;

/* The field's function, and walk_lanes (walk.h) with the function inlined: for any processor, and in
   LANES_WIDE functions. */
struct LevelKind {
    const char *name;
    LaneField at[2];
    WalkLanes walk[2];
    void (*parts)(const LevelField *field, LevelParts *out); /* NULL: the field's own numbers */
};

static inline void level_lanes(const LevelField *field, const LanePlace *place, LaneSample *out)
{
    field->kind->at[lanes_wide()](field, place, out);
}

void level_parts(const LevelField *field, LevelParts *out);

/* Crossings of a level by straight lines of all directions. With the motion-invariant measure on lines that
   meet a box, the crossings with a surface inside are uniform in area, and a line has 2 S / (area of the
   box) crossings on average. So crossings give the surface's area, and starts for walks on all parts of the
   surface in proportion. After: L. Santaló, "Integral geometry and geometric probability", 1976, chapter 14
   (Cauchy, Crofton). The lines are a shifted low-discrepancy sequence, so both are more accurate than with
   random lines: M. Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018. */

typedef struct LineSearch {
    const LevelField *field;
    double level;
    double low[3], high[3]; /* m: the box */
    PhiloxKey key;
    int threads;
} LineSearch;

typedef struct Crossings {
    size_t count;
    float (*place)[3];      /* m; in the lines' order: the first n are as uniform as the whole */
    double low[3], high[3]; /* m: extent of the crossings */
    double area;            /* m2: of the surface */
    size_t lines;
} Crossings;

/* Follows some thousand lines. Returns false with the reason if no line crosses the level, the field is not
   finite somewhere, or its march is too fine for its bounds; then nothing needs freeing. */
bool lines_cross(const LineSearch *search, Crossings *crossings, Error *error);

/* Adds lines until there are about `wanted` crossings, or two million lines. */
bool lines_more(const LineSearch *search, size_t wanted, Crossings *crossings, Error *error);

void crossings_free(Crossings *crossings);

/* Counting spheres: measure the density of points on nearly flat parts of a surface. After: S. Tanaka et
   al., "Particle-based transparent rendering of implicit surfaces", 2012, section 4: a small sphere about
   each of a hundred random points of the surface. The surface cuts the sphere in a great circle of area S,
   and n points fall into the sphere.

   A sphere that holds more surface than its great circle would count too many points. So in a valid sphere
   all known points of the surface are near the tangent plane and have similar normals, and the bounds do
   not cut the sphere. If few spheres are valid, all are made smaller. On surfaces folded more finely than
   the known points show, n is still wrong: sampling.c compares n with the area. */

enum { COUNTING_SPHERES = 250, COUNTING_CANDIDATES = 750, COUNTING_CELLS = 24 };

typedef struct Counting {
    int count; /* of spheres, at most COUNTING_SPHERES */
    float centre[COUNTING_SPHERES][3], radius;
    uint32_t inside[COUNTING_SPHERES]; /* points counted so far */
    double low[3], cell[3];            /* of a grid over the surface that lists the spheres near a cell */
    uint32_t begin[COUNTING_CELLS * COUNTING_CELLS * COUNTING_CELLS + 1];
    uint8_t *member;
} Counting;

/* Chooses spheres about crossings from number `walkers` on, where no walker began: around its own start a
   walker would count too many points. With fewer than COUNTING_CANDIDATES further crossings, about any
   crossing. Returns false if memory is short. */
bool counting_begin(Counting *counting, const LineSearch *search, const Crossings *crossings, size_t walkers,
                    Error *error);

void counting_add(Counting *counting, const SurfacePoint *point, size_t count, int threads);

double counting_mean(const Counting *counting); /* n */

void counting_end(Counting *counting);

#endif
