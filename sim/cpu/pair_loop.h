/* The walk over neighbours, shared by all pair loops. For files compiled for each instruction set.

   LANES particles walk their lists side by side, a lane each. A particle's sum follows the order of its
   list at any width, and no sum over lanes is needed. */
#ifndef SIM_CPU_PAIR_LOOP_H
#define SIM_CPU_PAIR_LOOP_H

#include "sim/base/simd.h"
#include "sim/box/box.h"
#include "sim/cpu/pairs.h"
#include "sim/kernel/kernel.h"
#include "sim/step/constants.h"

#include <math.h>
#include <string.h>

/* GROUPS (i, begin, end) { ... }: for each group of LANES particles i, i + 1, ... that overlaps [begin,
   end). */
#define GROUPS(i, begin, end) for (size_t i = (begin) / LANES * LANES; i < (end); i += LANES)

/* Stores results of group i within [begin, end): the rest of the group may belong to a different thread. */
SIMD_INLINE void lanes_store(float *column, size_t i, size_t begin, size_t end, f8 value)
{
    if (i >= begin && i + LANES <= end)
        f8_store(column + i, value);
    else
        for (size_t k = 0; k < LANES; k++)
            if (i + k >= begin && i + k < end)
                column[i + k] = value[k];
}

SIMD_INLINE void lanes_add(float *column, size_t i, size_t begin, size_t end, f8 value)
{
    lanes_store(column, i, begin, end, f8_load(column + i) + value);
}

/* Positions of a group's particles. */
typedef struct LaneVector {
    f8 x, y, z;
} LaneVector;

SIMD_INLINE LaneVector place_of(const PairArgs *args, size_t i)
{
    return (LaneVector){f8_load(args->x + i), f8_load(args->y + i), f8_load(args->z + i)};
}

/* The lists of a group. */
typedef struct NeighbourRange {
    const uint32_t *first, *end;
    bool coincident; /* some particle of the group nearly coincides with a neighbour */
    bool solid;      /* some particle of the group may have a boundary particle as neighbour */
} NeighbourRange;

SIMD_INLINE NeighbourRange neighbour_range_of(const PairArgs *args, size_t i)
{
    const NeighbourLists *lists = args->lists;
    const uint32_t *first = lists->of_range[i / LISTS_GRAIN].index + lists->first[i / LANES],
                   rows = lists->rows[i / LANES];
    return (NeighbourRange){first, first + LANES * (rows & ~(uint32_t)LISTS_FLAGS),
                            (rows & LISTS_COINCIDENT) != 0, (rows & LISTS_SOLID) != 0};
}

/* NEIGHBOURS (near, j) { const Separation d = separation(args, at, j); ... }: for the next neighbour of
   each lane; j points to the neighbours' entries. */
#define NEIGHBOURS(near, j) for (const uint32_t *j = (near).first; j < (near).end; j += LANES)

/* A neighbour per lane: x_ij = x_i - x_j, m; r^2, far above h^2 past the list's end; p_j V_j^2. */
typedef struct Separation {
    f8 x, y, z, r2, term;
} Separation;

/* From neighbours at p, in the layout of args->place. */
SIMD_INLINE Separation apart(LaneVector at, f8x4 p)
{
    Separation d = {.x = at.x - p.x, .y = at.y - p.y, .z = at.z - p.z, .term = p.w};
    d.r2 = d.x * d.x + d.y * d.y + d.z * d.z;
    return d;
}

SIMD_INLINE Separation separation(const PairArgs *args, LaneVector at, const uint32_t *j)
{
    return apart(at, f8_load4(args->place, j));
}

/* v_j, m/s, and V_j. */
SIMD_INLINE f8x4 motion(const PairArgs *args, const uint32_t *j)
{
    return f8_load4(args->motion, j);
}

/* 1 - r / h; 0 past the list's end. */
SIMD_INLINE f8 closeness(f8 q)
{
    return f8_positive(f8_splat(1) - q);
}

/* Shared code of pair loops. For files compiled for each instruction set. */

/* PAIR_LOOP(name) { body }: a pair loop with a separate name in each set; its arguments are those of
   PairLoop. */
#define PAIR_JOIN(name, set)   name##_##set
#define PAIR_EXPAND(name, set) PAIR_JOIN(name, set)
#define PAIR_NAME(name)        PAIR_EXPAND(name, SIMD_SET)
#define PAIR_LOOP(name)                                                                                      \
    PairLoop PAIR_NAME(name);                                                                                \
    void PAIR_NAME(name)(const PairArgs *args, size_t begin, size_t end)

/* Harmonic mean of two viscosities: pair_viscosity of sim/def/fluids.h. */
SIMD_INLINE f8 harmonic(f8 a, f8 b)
{
    return f8_splat(4) * a * b / greater(a + b, f8_splat(1e-30F));
}

/* Viscosity of a pair; without a division for a single fluid. */
SIMD_INLINE f8 pair_viscosities(const PairArgs *args, f8 mi, const uint32_t *j)
{
    return args->viscosity ? harmonic(mi, f8_gather(args->viscosity, j)) : mi + mi;
}

static uint32_t folded_id(ParticleId id)
{
    return (uint32_t)(id ^ id >> 32);
}

/* A direction from the two ids alone, opposite for (a, b) and (b, a); in the plane for two dimensions. */
static void direction_of_ids(ParticleId a, ParticleId b, int dimensions, float out[3])
{
    const uint32_t low = folded_id(a < b ? a : b), high = folded_id(a < b ? b : a);
    uint32_t hash = low * 0x9e3779b1u ^ (high * 0x85ebca77u + 0x165667b1u);
    float length2 = 0;
    for (int k = 0; k < dimensions; k++) {
        hash = (hash ^ hash >> 15) * 0x2c1b3c6du;
        hash ^= hash >> 13;
        out[k] = (float)(hash >> 8) * 0x1p-23f - 1 + 0x1p-24f; /* never 0 */
        length2 += out[k] * out[k];
    }
    const float scale = (a < b ? 1.0f : -1.0f) / sqrtf(length2);
    for (int k = 0; k < dimensions; k++)
        out[k] *= scale;
}

/* Assumed distance of coincident pairs, in h. TWINS_NEAR: negligible beside h, for pressure forces that do
   not vanish at r = 0. TWINS_PART: for solvers of the number density, which need a gradient (Wendland C2: 0
   at r = 0, two thirds of the maximum at 0.1 h). */
#define TWINS_NEAR 1e-6f
#define TWINS_PART 0.1f

/* Gives coincident pairs a direction by their ids and the distance `part` in h (DESIGN 3). By value, so
   that the usual case without coincident pairs stays in registers. */
static __attribute__((noinline, unused)) Separation separate_to(const PairArgs *args, size_t i,
                                                                const uint32_t *j, Separation d, float part)
{
    const float h = args->constants->support_radius, least = TWINS_NEAR * h, length = part * h;
    for (int k = 0; k < LANES; k++)
        if (d.r2[k] < least * least) {
            float direction[3] = {0};
            direction_of_ids(args->id[i + (size_t)k], args->id[list_particle(j[k])],
                             args->constants->dimensions, direction);
            d.x[k] = direction[0] * length;
            d.y[k] = direction[1] * length;
            d.z[k] = direction[2] * length;
            d.r2[k] = length * length;
        }
    return d;
}

static inline __attribute__((unused)) Separation separate(const PairArgs *args, size_t i, const uint32_t *j,
                                                          Separation d)
{
    return separate_to(args, i, j, d, TWINS_NEAR);
}

/* Images of particles in the box's walls (sim/box/box.h), per group. For files compiled for each
   instruction set. */

/* An image of each particle of a group: position and signs of the mirror. Lanes without an image stand far
   away. All neighbours of an image are neighbours of the particle, which is nearer to everything on its
   side of the wall. An image can see the particle itself. */
typedef struct ImageParticle {
    LaneVector at, sign;
} ImageParticle;

/* Images of a group, in the order of wall_images. */
typedef struct LaneImages {
    int count; /* without the particles, which are entry 0 */
    ImageParticle of[IMAGES_MAX];
    f8 near2[IMAGES_MAX]; /* squared distance of each image to the box, m2 */
    i8 there[IMAGES_MAX]; /* mask of the particles that have the image */
} LaneImages;

/* The region of particles without wall images; the margin covers rounding of squares. */
SIMD_INLINE WallsFar out_of_sight(const Constants *s)
{
    return walls_far(&s->walls, 1.001f * s->support_radius);
}

SIMD_INLINE i8 beside_walls(const WallsFar *far, const LaneVector *at)
{
    return (at->x < f8_splat(far->low[0])) | (at->x > f8_splat(far->high[0])) |
           (at->y < f8_splat(far->low[1])) | (at->y > f8_splat(far->high[1])) |
           (at->z < f8_splat(far->low[2])) | (at->z > f8_splat(far->high[2]));
}

/* Mirrors images 0 to `from` - 1 in the wall across `axis` at `wall`, on `side`. `d`: distance of the
   particles to the wall. */
SIMD_INLINE void mirror_in(LaneImages *images, int from, int axis, float wall, float side, f8 d, float h2)
{
    const f8 at = f8_splat(wall) - f8_splat(side) * d, d2 = d * d, away = f8_splat(-PAST), none = f8_splat(0);
    for (int k = 0; k < from; k++) {
        const f8 near2 = images->near2[k] + d2;
        const i8 there = images->there[k] & (near2 < f8_splat(h2));
        if (i8_bits(there) == 0)
            continue;
        const int to = ++images->count;
        const ImageParticle *of = &images->of[k];
        const f8 x = axis == 0 ? at : of->at.x, y = axis == 1 ? at : of->at.y, z = axis == 2 ? at : of->at.z;
        const f8 one = f8_splat(-1);
        images->near2[to] = near2;
        images->there[to] = there;
        images->of[to].at =
            (LaneVector){f8_select(there, x, away), f8_select(there, y, away), f8_select(there, z, away)};
        images->of[to].sign = (LaneVector){f8_select(there, axis == 0 ? one : of->sign.x, none),
                                           f8_select(there, axis == 1 ? one : of->sign.y, none),
                                           f8_select(there, axis == 2 ? one : of->sign.z, none)};
    }
}

/* Fills in wall_images of each particle of the group; false if no particle has an image. */
SIMD_INLINE bool images_of(const PairArgs *args, const WallsFar *far, size_t i, size_t begin, size_t end,
                           LaneImages *images)
{
    const Constants *s = args->constants;
    const Walls *walls = &s->walls;
    const float h = s->support_radius, least = 1e-3f * walls->spacing;
    const LaneVector at = place_of(args, i);
    const f8 along[3] = {at.x, at.y, at.z}, one = f8_splat(1);
    const i8 lane = lane_index + i8_splat((int32_t)i);
    images->count = 0;
    images->there[0] =
        beside_walls(far, &at) & (lane >= i8_splat((int32_t)begin)) & (lane < i8_splat((int32_t)end));
    if (i8_bits(images->there[0]) == 0)
        return false;
    images->near2[0] = f8_splat(0);
    images->of[0] = (ImageParticle){at, {one, one, one}};
    for (int a = 0; a < walls->dimensions; a++) {
        const float low = a == 1 ? 0 : -walls->half_size[a], high = low + 2 * walls->half_size[a];
        const int from = images->count + 1;
        const f8 up = along[a] - f8_splat(low), down = f8_splat(high) - along[a];
        if (walls->open[a])
            continue;
        mirror_in(images, from, a, low, 1, greater(up, f8_splat(least)), h * h);
        mirror_in(images, from, a, high, -1, greater(down, f8_splat(least)), h * h);
    }
    return images->count > 0;
}

typedef struct SelfLanes {
    uint32_t j[LANES];
} SelfLanes;

SIMD_INLINE SelfLanes themselves(const PairArgs *args, size_t i)
{
    SelfLanes own;
    for (uint32_t k = 0; k < LANES; k++)
        own.j[k] = list_entry(i + k < args->count ? i + k : args->none);
    return own;
}

SIMD_INLINE NeighbourRange neighbours_of_own_lanes(const SelfLanes *own)
{
    return (NeighbourRange){own->j, own->j + LANES, false, false};
}

/* The kernels named by solver.kernel, in pair loops. For files compiled for each instruction set. */

/* Kernel slope f(q) = -w'(q) / q, up to a factor in the caller's scale; 0 from q = 1 on.

   w is 1 - 6 q^2 + 6 q^3 and 2 (1 - q)^3 for the cubic; (1 - q)^4 (1 + 4 q) for Wendland C2; for the
   quintic the powers of 3 - 3 q, 2 - 3 q, 1 - 3 q. */
SIMD_INLINE f8 shape(f8 q, const ShapeKernel kernel)
{
    const f8 one = f8_splat(1), zero = f8_splat(0), t = closeness(q);
    if (kernel == KERNEL_WENDLAND_C2)
        return f8_splat(20) * (t * t * t);
    if (kernel == KERNEL_CUBIC)
        return f8_select(q < f8_splat(0.5f), f8_splat(12) - f8_splat(18) * q, f8_splat(6) * (t * t) / q);
    const f8 a = f8_splat(3) * t, b = a - one, c = b - one;
    const f8 a2 = a * a, b2 = f8_masked(b > zero, b * b), c2 = f8_masked(c > zero, c * c);
    return (a2 * a2 - f8_splat(6) * (b2 * b2) + f8_splat(15) * (c2 * c2)) / q;
}

/* w(q) / w(0); 0 from q = 1 on. */
SIMD_INLINE f8 height(f8 q, const ShapeKernel kernel)
{
    const f8 one = f8_splat(1), zero = f8_splat(0), t = closeness(q), t2 = t * t;
    if (kernel == KERNEL_WENDLAND_C2)
        return t2 * t2 * (one + f8_splat(4) * q);
    if (kernel == KERNEL_CUBIC)
        return f8_select(q < f8_splat(0.5f), one - f8_splat(6) * (q * q * t), f8_splat(2) * (t2 * t));
    const f8 a = f8_splat(3) * t, b = a - one, c = b - one;
    const f8 a2 = a * a, b2 = f8_masked(b > zero, b * b), c2 = f8_masked(c > zero, c * c);
    return (a2 * a2 * a - f8_splat(6) * (b2 * b2 * b) + f8_splat(15) * (c2 * c2 * c)) / f8_splat(66);
}

/* The wall images of each group and the neighbours of each image, kept from the first walk of a step for
   later walks. An image sees an eighth of the neighbours of its particles. For methods with
   Method.keeps_images; for files compiled for each instruction set. */

/* Layout of an image in ListMemory, LANES numbers per part: {rows of the image's list, 1 if the group has a
   further image}, position (3), signs of the mirror (3), then the rows. If the image sees its own particle,
   the particle comes first. */
enum { IMAGE_HEAD = LANES, IMAGE_ENTRIES = 7 * LANES };
_Static_assert(sizeof(ImageParticle) == (IMAGE_ENTRIES - IMAGE_HEAD) * sizeof(uint32_t),
               "it stands there as it is");

/* The first image of the group or NULL. */
SIMD_INLINE const uint32_t *first_image(const PairArgs *args, size_t i)
{
    const NeighbourLists *lists = args->lists;
    const uint32_t images = lists->images[i / LANES];
    return images > 0 ? lists->of_images[i / LISTS_GRAIN].index + images - 1 : NULL;
}

/* Reads the image at `from` and its neighbours. Returns the next image or NULL. */
SIMD_INLINE const uint32_t *next_image(const uint32_t *from, ImageParticle *image, NeighbourRange *near)
{
    memcpy(image, from + IMAGE_HEAD, sizeof *image);
    *near =
        (NeighbourRange){from + IMAGE_ENTRIES, from + IMAGE_ENTRIES + (size_t)LANES * from[0], false, false};
    return from[1] ? near->end : NULL;
}

#endif
