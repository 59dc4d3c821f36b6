/* Images of particles in the box's walls (sim/box/wall_images.h), per group. For files compiled for each
   instruction set. */
#ifndef SLOSH_PAIR_IMAGES_H
#define SLOSH_PAIR_IMAGES_H

#include "sim/box/wall_images.h"
#include "sim/cpu/walk.h"
#include "sim/world/constants.h"

/* An image of each particle of a group: position and signs of the mirror. Lanes without an image stand far
   away. All neighbours of an image are neighbours of the particle, which is nearer to everything on its
   side of the wall. An image can see the particle itself. */
typedef struct Mirrored {
    Place at, sign;
} Mirrored;

/* Images of a group, in the order of wall_images. */
typedef struct Images {
    int count; /* without the particles, which are entry 0 */
    Mirrored of[IMAGES_MAX];
    f8 near2[IMAGES_MAX]; /* squared distance of each image to the box, m2 */
    i8 there[IMAGES_MAX]; /* mask of the particles that have the image */
} Images;

/* The region of particles without wall images; the margin covers rounding of squares. */
SIMD_INLINE WallsFar out_of_sight(const Constants *s)
{
    return walls_far(&s->walls, 1.001f * s->support_radius);
}

SIMD_INLINE i8 beside_walls(const WallsFar *far, const Place *at)
{
    return (at->x < f8_splat(far->low[0])) | (at->x > f8_splat(far->high[0])) |
           (at->y < f8_splat(far->low[1])) | (at->y > f8_splat(far->high[1])) |
           (at->z < f8_splat(far->low[2])) | (at->z > f8_splat(far->high[2]));
}

/* Mirrors images 0 to `from` - 1 in the wall across `axis` at `wall`, on `side`. `d`: distance of the
   particles to the wall. */
SIMD_INLINE void mirror_in(Images *images, int from, int axis, float wall, float side, f8 d, float h2)
{
    const f8 at = f8_splat(wall) - f8_splat(side) * d, d2 = d * d, away = f8_splat(-PAST), none = f8_splat(0);
    for (int k = 0; k < from; k++) {
        const f8 near2 = images->near2[k] + d2;
        const i8 there = images->there[k] & (near2 < f8_splat(h2));
        if (i8_bits(there) == 0)
            continue;
        const int to = ++images->count;
        const Mirrored *of = &images->of[k];
        const f8 x = axis == 0 ? at : of->at.x, y = axis == 1 ? at : of->at.y, z = axis == 2 ? at : of->at.z;
        const f8 one = f8_splat(-1);
        images->near2[to] = near2;
        images->there[to] = there;
        images->of[to].at =
            (Place){f8_select(there, x, away), f8_select(there, y, away), f8_select(there, z, away)};
        images->of[to].sign = (Place){f8_select(there, axis == 0 ? one : of->sign.x, none),
                                      f8_select(there, axis == 1 ? one : of->sign.y, none),
                                      f8_select(there, axis == 2 ? one : of->sign.z, none)};
    }
}

/* Fills in wall_images of each particle of the group; false if no particle has an image. */
SIMD_INLINE bool images_of(const PairArgs *args, const WallsFar *far, size_t i, size_t begin, size_t end,
                           Images *images)
{
    const Constants *s = args->constants;
    const Walls *walls = &s->walls;
    const float h = s->support_radius, least = 1e-3f * walls->spacing;
    const Place at = place_of(args, i);
    const f8 along[3] = {at.x, at.y, at.z}, one = f8_splat(1);
    const i8 lane = lane_index + i8_splat((int32_t)i);
    images->count = 0;
    images->there[0] =
        beside_walls(far, &at) & (lane >= i8_splat((int32_t)begin)) & (lane < i8_splat((int32_t)end));
    if (i8_bits(images->there[0]) == 0)
        return false;
    images->near2[0] = f8_splat(0);
    images->of[0] = (Mirrored){at, {one, one, one}};
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

typedef struct Themselves {
    uint32_t j[LANES];
} Themselves;

SIMD_INLINE Themselves themselves(const PairArgs *args, size_t i)
{
    Themselves own;
    for (uint32_t k = 0; k < LANES; k++)
        own.j[k] = i + k < args->count ? (uint32_t)i + k : args->none;
    return own;
}

SIMD_INLINE Near near_themselves(const Themselves *own)
{
    return (Near){own->j, own->j + LANES, false};
}

#endif
