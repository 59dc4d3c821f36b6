/* Walkers on a surface, eight at a time; fields are inlined. After: S. Tanaka et al., "Particle-based
   transparent rendering of implicit surfaces and its application to fused visualization", 2012, section 4.

   A step: tangential noise and curvature drift (eq. 3), Newton's correction back to the level, and
   bisection along the normal if Newton fails. A step without a way back, beyond the bounds or further than
   `reach` is rejected: the walker stays, and its position counts again. A step and its reverse are equally
   probable, so the density stays uniform up to the edge. */
#ifndef SIM_POINTS_WALK_H
#define SIM_POINTS_WALK_H

#include "sim/points/level_kind.h"

#include "sim/points/lanes.h"

#include <stdbool.h>

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

LANES_INLINE Lanes lane_square(const LaneSample *s)
{
    return s->x * s->x + s->y * s->y + s->z * s->z;
}

/* Tr(H P) = laplacian - n H n; `straight` xx, yy, zz, `across` xy, yz, zx. */
LANES_INLINE Lanes lane_bend(const LaneSample *s, const Lanes straight[3], const Lanes across[3])
{
    const Lanes along =
        s->x * s->x * straight[0] + s->y * s->y * straight[1] + s->z * s->z * straight[2] +
        lanes(2) * (s->x * s->y * across[0] + s->y * s->z * across[1] + s->z * s->x * across[2]);
    return straight[0] + straight[1] + straight[2] - along / lane_square(s);
}

/* Lanes with a position on the level: |f - c| <= close |grad f|, to first order the distance. False for a
   zero gradient or NaN. */
LANES_INLINE LaneMask lane_on_level(const Walk *walk, const LaneSample *s)
{
    const Lanes miss = s->value - lanes(walk->level), square = lane_square(s);
    return (miss * miss <= lanes(walk->close * walk->close) * square) & (square > lanes(0));
}

LANES_INLINE LanePlace lane_along(const LanePlace *from, const LaneSample *s, Lanes by)
{
    return (LanePlace){from->x + by * s->x, from->y + by * s->y, from->z + by * s->z};
}

/* Newton's method along the gradient. Returns the lanes that reached the level. */
LANES_INLINE LaneMask lane_newton(const Walk *walk, LaneField at, LanePlace *place, LaneSample *s)
{
    at(walk->field, place, s);
    LaneMask done = lane_on_level(walk, s);
    for (int k = 0; k < NEWTON_STEPS && lanes_bits(done) != 0xff; k++) {
        const Lanes by = (lanes(walk->level) - s->value) / lane_square(s);
        *place = lane_along(place, s, lanes_select(done, lanes(0), by));
        at(walk->field, place, s);
        done = lane_on_level(walk, s);
    }
    return done;
}

/* Finds the level on the normal of `from` through `place`, between -reach and reach; lanes without the
   level end off the level. */
LANES_INLINE void lane_bisect(const Walk *walk, LaneField at, const LaneSample *from, const LanePlace *place,
                              LanePlace *found, LaneSample *s)
{
    const Lanes inverse = lanes(walk->reach) / lanes_sqrt(lane_square(from)), level = lanes(walk->level);
    Lanes a = -inverse, b = inverse;
    *found = lane_along(place, from, a);
    at(walk->field, found, s);
    const LaneMask sign = s->value < level;
    for (int k = 0; k < HALVINGS; k++) {
        const Lanes middle = lanes(0.5F) * (a + b);
        *found = lane_along(place, from, middle);
        at(walk->field, found, s);
        const LaneMask lower = (s->value < level) == sign;
        a = lanes_select(lower, middle, a);
        b = lanes_select(lower, b, middle);
    }
}

LANES_INLINE LaneMask lane_near(const Walk *walk, const LanePlace *p, const LanePlace *from)
{
    const Lanes dx = p->x - from->x, dy = p->y - from->y, dz = p->z - from->z;
    return dx * dx + dy * dy + dz * dz <= lanes(walk->reach * walk->reach);
}

LANES_INLINE LaneMask lane_inside(const Walk *walk, const LanePlace *p)
{
    return (p->x >= lanes(walk->low[0])) & (p->x <= lanes(walk->high[0])) & (p->y >= lanes(walk->low[1])) &
           (p->y <= lanes(walk->high[1])) & (p->z >= lanes(walk->low[2])) & (p->z <= lanes(walk->high[2]));
}

/* Eq. 3 by Euler's method: P dw with <dw dw> = 2 dt, and -dt (grad f / |grad f|^2) Tr(H P). */
LANES_INLINE LanePlace lane_euler(const Walk *walk, const LanePlace *p, const LaneSample *s,
                                  const Lanes normal[3])
{
    const Lanes step = lanes(walk->step), inverse = lanes(1) / lane_square(s);
    const Lanes x = step * normal[0], y = step * normal[1], z = step * normal[2];
    const Lanes along = (x * s->x + y * s->y + z * s->z) * inverse;
    const Lanes drift = lanes(0.5F * walk->step * walk->step) * s->bend * inverse;
    const LanePlace moved = {p->x + x, p->y + y, p->z + z};
    return lane_along(&moved, s, -along - drift);
}

LANES_INLINE void lane_keep(LaneMask taken, const LanePlace *to, const LaneSample *there, LanePlace *p,
                            LaneSample *s)
{
    p->x = lanes_select(taken, to->x, p->x);
    p->y = lanes_select(taken, to->y, p->y);
    p->z = lanes_select(taken, to->z, p->z);
    s->value = lanes_select(taken, there->value, s->value);
    s->x = lanes_select(taken, there->x, s->x);
    s->y = lanes_select(taken, there->y, s->y);
    s->z = lanes_select(taken, there->z, s->z);
    s->bend = lanes_select(taken, there->bend, s->bend);
}

/* A step of eight walkers. Returns the lanes with an accepted step. */
LANES_INLINE LaneMask lane_step(const Walk *walk, LaneField at, const Lanes normal[3], LanePlace *p,
                                LaneSample *s)
{
    LaneSample there;
    const LanePlace moved = lane_euler(walk, p, s, normal);
    LanePlace to = moved;
    LaneMask found = lane_newton(walk, at, &to, &there) & lane_near(walk, &to, p);
    const LaneMask taken = found & lane_inside(walk, &to);
    const LaneMask lost = ~found & lane_inside(walk, &moved);
    const LanePlace here = *p;
    const LaneSample slope = *s;
    lane_keep(taken, &to, &there, p, s);
    if (lanes_bits(lost) == 0 || walk->no_bisection)
        return taken;
    lane_bisect(walk, at, &slope, &moved, &to, &there);
    found = lost & lane_on_level(walk, &there) & lane_near(walk, &to, &here) & lane_inside(walk, &to);
    lane_keep(found, &to, &there, p, s);
    return taken | found;
}

/* Same packing as surface_normal_pack. */
LANES_INLINE LaneMask lane_pack(const LaneSample *s)
{
    const Lanes one = lanes(1), scale = one / (lanes_abs(s->x) + lanes_abs(s->y) + lanes_abs(s->z));
    const Lanes x = s->x * scale, y = s->y * scale;
    const LaneMask lower = s->z < lanes(0);
    const Lanes u = lanes_select(lower, lanes_signed(one - lanes_abs(y), x), x);
    const Lanes v = lanes_select(lower, lanes_signed(one - lanes_abs(x), y), y);
    return (lanes_whole(lanes_round(lanes(32767) * u)) & 0xffff) |
           (lanes_whole(lanes_round(lanes(32767) * v)) << 16);
}

LANES_INLINE void lane_write(const Walk *walk, size_t w, size_t k, const LanePlace *p, const LaneSample *s)
{
    const LaneMask normal = lane_pack(s);
    for (size_t lane = 0; lane < LANES; lane++)
        walk->out[(w + lane) * walk->count + k] =
            (SurfacePoint){.position = {p->x[lane], p->y[lane], p->z[lane]},
                           .normal = (uint32_t)normal[lane],
                           .surface = walk->surface,
                           .value = walk->level};
}

LANES_INLINE Lanes lanes_from(const float *p)
{
    Lanes a;
    __builtin_memcpy(&a, p, sizeof a);
    return a;
}

LANES_INLINE void lanes_to(float *p, Lanes a)
{
    __builtin_memcpy(p, &a, sizeof a);
}

/* Steps of eight walkers, with random numbers of counter {walker, step, 0, PHILOX_WALK}. */
LANES_INLINE void walk_eight(const Walk *walk, size_t w, LaneField at)
{
    const Walkers *all = walk->walkers;
    const LaneMask index = {0, 1, 2, 3, 4, 5, 6, 7};
    LanePlace p = {lanes_from(all->place[0] + w), lanes_from(all->place[1] + w),
                   lanes_from(all->place[2] + w)};
    LaneSample s;
    LaneMask taken = {0};
    at(walk->field, &p, &s);
    for (uint32_t k = 0; k < walk->count; k++) {
        LaneWords word[4] = {(LaneWords)(index + (int32_t)w)};
        word[1] = (LaneWords){0} + (walk->first + k);
        word[2] = (LaneWords){0};
        word[3] = (LaneWords){0} + (uint32_t)PHILOX_WALK;
        Lanes normal[3];
        philox_lanes(walk->key, word);
        philox_normal_lanes(word, normal);
        taken -= lane_step(walk, at, normal, &p, &s);
        if (walk->out)
            lane_write(walk, w, k, &p, &s);
    }
    lanes_to(all->place[0] + w, p.x);
    lanes_to(all->place[1] + w, p.y);
    lanes_to(all->place[2] + w, p.z);
    for (int lane = 0; lane < LANES; lane++)
        all->taken[w + (size_t)lane] += (uint32_t)taken[lane];
}

/* Walkers begin .. end - 1; begin and end are multiples of LANES. */
LANES_INLINE void walk_lanes(const Walk *walk, size_t begin, size_t end, LaneField at)
{
    for (size_t w = begin; w < end; w += LANES)
        walk_eight(walk, w, at);
}

/* Defines NAME_kind from the field NAME_at, a LANES_INLINE function; PARTS gives the data for its shader. */
#define LEVEL_KIND(NAME) LEVEL_KIND_OF(NAME, NULL)
#define LEVEL_KIND_OF(NAME, PARTS)                                                                           \
    static void NAME##_narrow(const LevelField *field, const LanePlace *place, LaneSample *out)              \
    {                                                                                                        \
        NAME##_at(field, place, out);                                                                        \
    }                                                                                                        \
    static LANES_WIDE void NAME##_wide(const LevelField *field, const LanePlace *place, LaneSample *out)     \
    {                                                                                                        \
        NAME##_at(field, place, out);                                                                        \
    }                                                                                                        \
    static void NAME##_walk(const Walk *walk, size_t begin, size_t end)                                      \
    {                                                                                                        \
        walk_lanes(walk, begin, end, NAME##_at);                                                             \
    }                                                                                                        \
    static LANES_WIDE void NAME##_walk_wide(const Walk *walk, size_t begin, size_t end)                      \
    {                                                                                                        \
        walk_lanes(walk, begin, end, NAME##_at);                                                             \
    }                                                                                                        \
    static const LevelKind NAME##_kind = {                                                                   \
        #NAME, {NAME##_narrow, NAME##_wide}, {NAME##_walk, NAME##_walk_wide}, PARTS};

#endif
