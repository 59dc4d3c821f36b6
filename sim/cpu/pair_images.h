/* The images of particles in the walls of the box (sim/box/wall_images.h), a group at a time. For the files
   that are compiled once for each instruction set. */
#ifndef SLOSH_PAIR_IMAGES_H
#define SLOSH_PAIR_IMAGES_H

#include "sim/box/wall_images.h"
#include "sim/cpu/walk.h"
#include "sim/world/constants.h"

/* An image of each particle of a group, of those that have one: where it stands, and its mirror's signs. Whom
   an image sees its particle sees too, since it is nearer to all on its own side of the wall; and the image
   sees the particle. */
typedef struct Mirrored {
    Place at, sign;
} Mirrored;

/* What the images of a group are: of each particle its own first, as wall_images has it. */
typedef struct Images {
    int most; /* of a particle */
    int count[LANES];
    Image of[LANES][IMAGES_MAX];
} Images;

/* Of the walls' images: wall_images rounds h. */
SIMD_INLINE WallsFar out_of_sight(const Constants *s)
{
    return walls_far(&s->walls, 1.001f * s->support_radius);
}

/* False where no particle of the group has any. */
SIMD_INLINE bool images_of(const PairArgs *args, const WallsFar *far, size_t i, size_t begin, size_t end,
                           Images *images)
{
    const Constants *s = args->constants;
    images->most = 0;
    for (size_t k = 0; k < LANES; k++) {
        images->count[k] = 0;
        if (i + k < begin || i + k >= end)
            continue;
        const float x[3] = {args->x[i + k], args->y[i + k], args->z[i + k]};
        if (walls_near(far, x))
            images->count[k] = wall_images(&s->walls, x, s->support_radius, images->of[k]);
        images->most = images->count[k] > images->most ? images->count[k] : images->most;
    }
    return images->most > 1;
}

/* The m-th of each; far from all where there is none. */
SIMD_INLINE Mirrored mirrored(const Images *images, int m)
{
    float at[3][LANES], sign[3][LANES];
    for (int lane = 0; lane < LANES; lane++)
        for (int k = 0; k < 3; k++) {
            const bool there = m < images->count[lane];
            at[k][lane] = there ? images->of[lane][m].x[k] : -PAST;
            sign[k][lane] = there ? images->of[lane][m].sign[k] : 0;
        }
    return (Mirrored){{f8_load(at[0]), f8_load(at[1]), f8_load(at[2])},
                      {f8_load(sign[0]), f8_load(sign[1]), f8_load(sign[2])}};
}

typedef struct Themselves {
    uint32_t j[LANES];
} Themselves;

SIMD_INLINE Themselves themselves(const PairArgs *args, size_t i)
{
    Themselves own;
    for (uint32_t k = 0; k < LANES; k++)
        own.j[k] = i + k < args->count ? (uint32_t)i + k : (uint32_t)args->count;
    return own;
}

SIMD_INLINE Near near_themselves(const Themselves *own)
{
    return (Near){own->j, own->j + LANES, false};
}

#endif
