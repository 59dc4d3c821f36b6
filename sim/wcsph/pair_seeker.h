/* Sources of neighbour searches in the additional sums of wcsph: particles and their wall images. For files
   compiled for each instruction set. */
#ifndef SLOSH_PAIR_SEEKER_H
#define SLOSH_PAIR_SEEKER_H

#include "sim/wcsph/pair_matrix.h"
#include "sim/wcsph/pair_mirror.h"

/* The particles of a group, or an image of each particle. */
typedef struct Seeker {
    Place at, sign;
    bool image;
} Seeker;

/* Fills in the seekers of a group, the particles first; returns their number. */
SIMD_INLINE int seekers_of(const PairArgs *args, const WallsFar *far, size_t i, size_t begin, size_t end,
                           Images *images)
{
    const f8 one = f8_splat(1);
    const bool has = images_of(args, far, i, begin, end, images);
    images->of[0] = (Mirrored){place_of(args, i), {one, one, one}};
    return has ? images->count + 1 : 1;
}

SIMD_INLINE Seeker seeker_of(const Images *images, int m)
{
    return (Seeker){images->of[m].at, images->of[m].sign, m > 0};
}

/* Continuation of pressure from particles to images found; 0 for particles. */
SIMD_INLINE Rise seeker_rise(const PairArgs *args, size_t i, const Seeker *from, const Layers *layers)
{
    const f8 zero = f8_splat(0);
    const Mirrored image = {from->at, from->sign};
    return from->image ? rise_of(args, i, &image, layers) : (Rise){zero, zero, zero, zero, zero};
}

/* F of a pair, up to scale. */
SIMD_INLINE f8 weight_of(const PairArgs *args, f8 r2, bool image, const ShapeKernel kernel)
{
    const float h = args->constants->support_radius, least = 1e-6f * h;
    const f8 inverse_h = f8_splat(1 / h), least2 = f8_splat(least * least);
    if (image)
        return image_shape(f8_sqrt(greater(r2, least2)) * inverse_h, f8_splat(args->constants->spacing / h),
                           kernel);
    return f8_masked(r2 >= least2, shape(f8_sqrt(r2) * inverse_h, kernel));
}

/* The matrix in a mirror's axes. */
SIMD_INLINE Symmetric mirrored(const Symmetric m, const Place sign)
{
    return (Symmetric){
        m.xx, m.yy, m.zz, m.xy * sign.x * sign.y, m.yz * sign.y * sign.z, m.zx * sign.z * sign.x};
}

SIMD_INLINE Place times(const Symmetric m, f8 x, f8 y, f8 z)
{
    return (Place){m.xx * x + m.xy * y + m.zx * z, m.xy * x + m.yy * y + m.yz * z,
                   m.zx * x + m.yz * y + m.zz * z};
}

/* C of sim/wcsph/corrected.c: for a group, and for its next neighbours. */
SIMD_INLINE Symmetric correction_of(const PairArgs *args, size_t i)
{
    float *const *c = args->own + CORRECTION;
    return (Symmetric){f8_load(c[0] + i), f8_load(c[1] + i), f8_load(c[2] + i),
                       f8_load(c[3] + i), f8_load(c[4] + i), f8_load(c[5] + i)};
}

SIMD_INLINE Symmetric correction_there(const PairArgs *args, const uint32_t *j)
{
    float *const *c = args->own + CORRECTION;
    return (Symmetric){f8_gather(c[0], j), f8_gather(c[1], j), f8_gather(c[2], j),
                       f8_gather(c[3], j), f8_gather(c[4], j), f8_gather(c[5], j)};
}

#endif
