/* What the samplers share: kinds of fields, crossings of a level by lines, counting spheres, and walkers
   with the field inlined. */
#ifndef SIM_POINTS_WALK_H
#define SIM_POINTS_WALK_H

#include "sim/points/points.h"

#include "sim/points/philox.h"

#include <stdbool.h>

/* What the samplers of points share: functions of a kind of field, and crossings of a level by lines. */

/* A kind of field: for the samplers, and for adding kinds (README.md). */

typedef struct LanePlace { /* m, the box's frame */
    f8 x, y, z;
} LanePlace;

typedef struct LaneSample { /* as LevelSample */
    f8 value, x, y, z, bend;
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
   SIMD_WIDE functions. */
struct LevelKind {
    const char *name;
    LaneField at[2];
    WalkLanes walk[2];
    void (*parts)(const LevelField *field, LevelParts *out); /* NULL: the field's own numbers */
};

static inline void level_lanes(const LevelField *field, const LanePlace *place, LaneSample *out)
{
    field->kind->at[simd_wide()](field, place, out);
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

/* Walkers on a surface, eight at a time; fields are inlined. After: S. Tanaka et al., "Particle-based
   transparent rendering of implicit surfaces and its application to fused visualization", 2012, section 4.

   A step: tangential noise and curvature drift (eq. 3), Newton's correction back to the level, and
   bisection along the normal if Newton fails. A step without a way back, beyond the bounds or further than
   `reach` is rejected: the walker stays, and its position counts again. A step and its reverse are equally
   probable, so the density stays uniform up to the edge. */

/* Walkers as columns; their number is a multiple of LANES. */
typedef struct Walkers {
    size_t count;
    float *place[3]; /* m: on the surface */
    uint32_t *taken; /* accepted steps per walker */
} Walkers;

/* The same steps for all walkers. */
struct Walk {
    const LevelField *field;
    const Walkers *walkers;
    float level;
    float low[3], high[3]; /* m: bounds of all steps */
    float step;            /* sqrt(2 dt), m */
    float close;           /* m: tolerance for points on the surface */
    float reach;           /* m: greatest length of a step */
    bool no_bisection;     /* rejects a step if Newton's method fails: for costly fields */
    PhiloxKey key;
    uint32_t first, count; /* steps, counted from the start of the walk */
    SurfacePoint *out;     /* walker w after its k-th step: [w count + k]; NULL: no output */
    uint32_t surface;      /* for `out` */
};

enum { NEWTON_STEPS = 5, HALVINGS = 16 };

SIMD_INLINE f8 lane_square(const LaneSample *s)
{
    return s->x * s->x + s->y * s->y + s->z * s->z;
}

/* Tr(H P) = laplacian - n H n; `straight` xx, yy, zz, `across` xy, yz, zx. */
SIMD_INLINE f8 lane_bend(const LaneSample *s, const f8 straight[3], const f8 across[3])
{
    const f8 along =
        s->x * s->x * straight[0] + s->y * s->y * straight[1] + s->z * s->z * straight[2] +
        f8_splat(2) * (s->x * s->y * across[0] + s->y * s->z * across[1] + s->z * s->x * across[2]);
    return straight[0] + straight[1] + straight[2] - along / lane_square(s);
}

/* f8 with a position on the level: |f - c| <= close |grad f|, to first order the distance. False for a
   zero gradient or NaN. */
SIMD_INLINE i8 lane_on_level(const Walk *walk, const LaneSample *s)
{
    const f8 miss = s->value - f8_splat(walk->level), square = lane_square(s);
    return (miss * miss <= f8_splat(walk->close * walk->close) * square) & (square > f8_splat(0));
}

SIMD_INLINE LanePlace lane_along(const LanePlace *from, const LaneSample *s, f8 by)
{
    return (LanePlace){from->x + by * s->x, from->y + by * s->y, from->z + by * s->z};
}

/* Newton's method along the gradient. Returns the lanes that reached the level. */
SIMD_INLINE i8 lane_newton(const Walk *walk, LaneField at, LanePlace *place, LaneSample *s)
{
    at(walk->field, place, s);
    i8 done = lane_on_level(walk, s);
    for (int k = 0; k < NEWTON_STEPS && i8_bits(done) != 0xff; k++) {
        const f8 by = (f8_splat(walk->level) - s->value) / lane_square(s);
        *place = lane_along(place, s, f8_select(done, f8_splat(0), by));
        at(walk->field, place, s);
        done = lane_on_level(walk, s);
    }
    return done;
}

/* Finds the level on the normal of `from` through `place`, between -reach and reach; lanes without the
   level end off the level. */
SIMD_INLINE void lane_bisect(const Walk *walk, LaneField at, const LaneSample *from, const LanePlace *place,
                             LanePlace *found, LaneSample *s)
{
    const f8 inverse = f8_splat(walk->reach) / f8_sqrt(lane_square(from)), level = f8_splat(walk->level);
    f8 a = -inverse, b = inverse;
    *found = lane_along(place, from, a);
    at(walk->field, found, s);
    const i8 sign = s->value < level;
    for (int k = 0; k < HALVINGS; k++) {
        const f8 middle = f8_splat(0.5F) * (a + b);
        *found = lane_along(place, from, middle);
        at(walk->field, found, s);
        const i8 lower = (s->value < level) == sign;
        a = f8_select(lower, middle, a);
        b = f8_select(lower, b, middle);
    }
}

SIMD_INLINE i8 lane_near(const Walk *walk, const LanePlace *p, const LanePlace *from)
{
    const f8 dx = p->x - from->x, dy = p->y - from->y, dz = p->z - from->z;
    return dx * dx + dy * dy + dz * dz <= f8_splat(walk->reach * walk->reach);
}

SIMD_INLINE i8 lane_inside(const Walk *walk, const LanePlace *p)
{
    return (p->x >= f8_splat(walk->low[0])) & (p->x <= f8_splat(walk->high[0])) &
           (p->y >= f8_splat(walk->low[1])) & (p->y <= f8_splat(walk->high[1])) &
           (p->z >= f8_splat(walk->low[2])) & (p->z <= f8_splat(walk->high[2]));
}

/* Eq. 3 by Euler's method: P dw with <dw dw> = 2 dt, and -dt (grad f / |grad f|^2) Tr(H P). */
SIMD_INLINE LanePlace lane_euler(const Walk *walk, const LanePlace *p, const LaneSample *s,
                                 const f8 normal[3])
{
    const f8 step = f8_splat(walk->step), inverse = f8_splat(1) / lane_square(s);
    const f8 x = step * normal[0], y = step * normal[1], z = step * normal[2];
    const f8 along = (x * s->x + y * s->y + z * s->z) * inverse;
    const f8 drift = f8_splat(0.5F * walk->step * walk->step) * s->bend * inverse;
    const LanePlace moved = {p->x + x, p->y + y, p->z + z};
    return lane_along(&moved, s, -along - drift);
}

SIMD_INLINE void lane_keep(i8 taken, const LanePlace *to, const LaneSample *there, LanePlace *p,
                           LaneSample *s)
{
    p->x = f8_select(taken, to->x, p->x);
    p->y = f8_select(taken, to->y, p->y);
    p->z = f8_select(taken, to->z, p->z);
    s->value = f8_select(taken, there->value, s->value);
    s->x = f8_select(taken, there->x, s->x);
    s->y = f8_select(taken, there->y, s->y);
    s->z = f8_select(taken, there->z, s->z);
    s->bend = f8_select(taken, there->bend, s->bend);
}

/* A step of eight walkers. Returns the lanes with an accepted step. */
SIMD_INLINE i8 lane_step(const Walk *walk, LaneField at, const f8 normal[3], LanePlace *p, LaneSample *s)
{
    LaneSample there;
    const LanePlace moved = lane_euler(walk, p, s, normal);
    LanePlace to = moved;
    i8 found = lane_newton(walk, at, &to, &there) & lane_near(walk, &to, p);
    const i8 taken = found & lane_inside(walk, &to);
    const i8 lost = ~found & lane_inside(walk, &moved);
    const LanePlace here = *p;
    const LaneSample slope = *s;
    lane_keep(taken, &to, &there, p, s);
    if (i8_bits(lost) == 0 || walk->no_bisection)
        return taken;
    lane_bisect(walk, at, &slope, &moved, &to, &there);
    found = lost & lane_on_level(walk, &there) & lane_near(walk, &to, &here) & lane_inside(walk, &to);
    lane_keep(found, &to, &there, p, s);
    return taken | found;
}

/* Same packing as surface_normal_pack. */
SIMD_INLINE i8 lane_pack(const LaneSample *s)
{
    const f8 one = f8_splat(1), scale = one / (f8_abs(s->x) + f8_abs(s->y) + f8_abs(s->z));
    const f8 x = s->x * scale, y = s->y * scale;
    const i8 lower = s->z < f8_splat(0);
    const f8 u = f8_select(lower, f8_copysign(one - f8_abs(y), x), x);
    const f8 v = f8_select(lower, f8_copysign(one - f8_abs(x), y), y);
    return (f8_truncate(f8_round(f8_splat(32767) * u)) & 0xffff) |
           (f8_truncate(f8_round(f8_splat(32767) * v)) << 16);
}

SIMD_INLINE void lane_write(const Walk *walk, size_t w, size_t k, const LanePlace *p, const LaneSample *s)
{
    const i8 normal = lane_pack(s);
    for (size_t lane = 0; lane < LANES; lane++)
        walk->out[(w + lane) * walk->count + k] =
            (SurfacePoint){.position = {p->x[lane], p->y[lane], p->z[lane]},
                           .normal = (uint32_t)normal[lane],
                           .surface = walk->surface,
                           .value = walk->level};
}

/* Steps of eight walkers, with random numbers of counter {walker, step, 0, PHILOX_WALK}. */
SIMD_INLINE void walk_eight(const Walk *walk, size_t w, LaneField at)
{
    const Walkers *all = walk->walkers;
    LanePlace p = {f8_load(all->place[0] + w), f8_load(all->place[1] + w), f8_load(all->place[2] + w)};
    LaneSample s;
    i8 taken = {0};
    at(walk->field, &p, &s);
    for (uint32_t k = 0; k < walk->count; k++) {
        u8 word[4] = {(u8)(lane_index + (int32_t)w)};
        word[1] = (u8){0} + (walk->first + k);
        word[2] = (u8){0};
        word[3] = (u8){0} + (uint32_t)PHILOX_WALK;
        f8 normal[3];
        philox_lanes(walk->key, word);
        philox_normal_lanes(word, normal);
        taken -= lane_step(walk, at, normal, &p, &s);
        if (walk->out)
            lane_write(walk, w, k, &p, &s);
    }
    f8_store(all->place[0] + w, p.x);
    f8_store(all->place[1] + w, p.y);
    f8_store(all->place[2] + w, p.z);
    for (int lane = 0; lane < LANES; lane++)
        all->taken[w + (size_t)lane] += (uint32_t)taken[lane];
}

/* Walkers begin .. end - 1; begin and end are multiples of LANES. */
SIMD_INLINE void walk_lanes(const Walk *walk, size_t begin, size_t end, LaneField at)
{
    for (size_t w = begin; w < end; w += LANES)
        walk_eight(walk, w, at);
}

/* Defines NAME_kind from the field NAME_at, a SIMD_INLINE function; PARTS gives the data for its shader. */
#define LEVEL_KIND(NAME) LEVEL_KIND_OF(NAME, NULL)
#define LEVEL_KIND_OF(NAME, PARTS)                                                                           \
    static void NAME##_narrow(const LevelField *field, const LanePlace *place, LaneSample *out)              \
    {                                                                                                        \
        NAME##_at(field, place, out);                                                                        \
    }                                                                                                        \
    static SIMD_WIDE void NAME##_wide(const LevelField *field, const LanePlace *place, LaneSample *out)      \
    {                                                                                                        \
        NAME##_at(field, place, out);                                                                        \
    }                                                                                                        \
    static void NAME##_walk(const Walk *walk, size_t begin, size_t end)                                      \
    {                                                                                                        \
        walk_lanes(walk, begin, end, NAME##_at);                                                             \
    }                                                                                                        \
    static SIMD_WIDE void NAME##_walk_wide(const Walk *walk, size_t begin, size_t end)                       \
    {                                                                                                        \
        walk_lanes(walk, begin, end, NAME##_at);                                                             \
    }                                                                                                        \
    static const LevelKind NAME##_kind = {                                                                   \
        #NAME, {NAME##_narrow, NAME##_wide}, {NAME##_walk, NAME##_walk_wide}, PARTS};

#endif
