/* Kernels of wcsph in its pair loops. */
#ifndef SIM_METHODS_WCSPH_PAIR_WCSPH_H
#define SIM_METHODS_WCSPH_PAIR_WCSPH_H

#include "sim/methods/wcsph/wcsph_private.h"

#include "sim/cpu/pair_loop.h"

/* `body(args, begin, end, kernel)` with the kernel as a constant, so that each kernel has a separate loop. */
#define FOR_KERNEL(args, begin, end, body)                                                                   \
    do {                                                                                                     \
        if (wcsph_constants((args)->constants)->kernel_shape == KERNEL_WENDLAND_C2)                          \
            body(args, begin, end, KERNEL_WENDLAND_C2);                                                      \
        else if (wcsph_constants((args)->constants)->kernel_shape == KERNEL_QUINTIC)                         \
            body(args, begin, end, KERNEL_QUINTIC);                                                          \
        else                                                                                                 \
            body(args, begin, end, KERNEL_CUBIC);                                                            \
    } while (0)

/* Symmetric matrices of a group of particles. For files compiled for each instruction set. */

typedef struct Symmetric {
    f8 xx, yy, zz, xy, yz, zx;
} Symmetric;

/* m^-1 b; 0 where det (3 m / trace) is below a quarter, since neighbours hardly span the space there.
   Inside the fluid det is 1, in a corner of the lattice 0.77. */
static __attribute__((unused)) LaneVector renormalise(const Symmetric m, const LaneVector b)
{
    const f8 cxx = m.yy * m.zz - m.yz * m.yz, cyy = m.xx * m.zz - m.zx * m.zx,
             czz = m.xx * m.yy - m.xy * m.xy;
    const f8 cxy = m.yz * m.zx - m.xy * m.zz, cyz = m.xy * m.zx - m.yz * m.xx,
             czx = m.xy * m.yz - m.zx * m.yy;
    const f8 det = m.xx * cxx + m.xy * cxy + m.zx * czx, mean = (m.xx + m.yy + m.zz) / f8_splat(3);
    const f8 scale = f8_masked(det > f8_splat(0.25f) * (mean * mean * mean), f8_splat(1) / det);
    return (LaneVector){scale * (cxx * b.x + cxy * b.y + czx * b.z),
                        scale * (cxy * b.x + cyy * b.y + cyz * b.z),
                        scale * (czx * b.x + cyz * b.y + czz * b.z)};
}

/* Weights of wall images in the sums of wcsph, and continuation of pressure behind walls. For files
   compiled for each instruction set. */

/* The kernel's slope over q; for pairs nearer than `apart`, the slope at `apart`. The kernel's slope
   vanishes for close pairs, and fluid would stick to its images. */
SIMD_INLINE f8 image_shape(f8 q, f8 apart, const ShapeKernel kernel)
{
    const f8 wide = greater(q, apart);
    return shape(wide, kernel) * (wide / q);
}

/* Continuation of pressure behind walls: p V0^2 of the image of j is p V0^2 of j plus g0 + g.x_ij, with
   x_ij = x_i' - x_j, since x_j' - x_j = 2 x_ij + x_i - x_i' along mirrored axes. The addition fades in over
   the pressure of a layer, so that a drop on a wall falls freely. */
typedef struct DensitySlope {
    f8 g0, gx, gy, gz, inverse_layer;
} DensitySlope;

/* The apparent gravity at the particles of a group, m/s2, by axis; 0 outside of the range. */
static __attribute__((unused)) void gravity_of(const PairArgs *args, size_t i, size_t begin, size_t end,
                                               float g[3][LANES])
{
    for (size_t k = 0; k < LANES; k++) {
        float at[3] = {0};
        if (i + k >= begin && i + k < end)
            apparent_gravity_at(args->gravity, (float[]){args->x[i + k], args->y[i + k], args->z[i + k]}, at);
        for (int a = 0; a < 3; a++)
            g[a][k] = at[a];
    }
}

/* Weight of a layer under gravity: per particle of a group rho0 V0^2 g, and 1 over its length times the
   spacing. */
typedef struct Layers {
    LaneVector pull;
    f8 inverse;
} Layers;

static __attribute__((unused)) Layers layers_of(const PairArgs *args, size_t i, size_t begin, size_t end)
{
    const Constants *s = args->constants;
    float g[3][LANES], pull[3][LANES] = {{0}}, inverse[LANES] = {0};
    gravity_of(args, i, begin, end, g);
    for (size_t k = 0; k < LANES; k++) {
        if (i + k < begin || i + k >= end)
            continue;
        const float weight = s->density[args->fluid[i + k]] /
                             (s->rest_number_density * s->rest_number_density); /* rho0 V0^2 */
        const float layer =
            weight * s->spacing * sqrtf(g[0][k] * g[0][k] + g[1][k] * g[1][k] + g[2][k] * g[2][k]);
        for (int a = 0; a < 3; a++)
            pull[a][k] = weight * g[a][k];
        inverse[k] = layer > 0 ? 1 / layer : 0;
    }
    return (Layers){{f8_load(pull[0]), f8_load(pull[1]), f8_load(pull[2])}, f8_load(inverse)};
}

static __attribute__((unused)) DensitySlope rise_of(const PairArgs *args, size_t i,
                                                    const ImageParticle *image, const Layers *layers)
{
    const f8 zero = f8_splat(0), two = f8_splat(2);
    const LaneVector x = place_of(args, i);
    const f8 gx = f8_masked(image->sign.x < zero, layers->pull.x),
             gy = f8_masked(image->sign.y < zero, layers->pull.y),
             gz = f8_masked(image->sign.z < zero, layers->pull.z);
    return (DensitySlope){gx * (x.x - image->at.x) + gy * (x.y - image->at.y) + gz * (x.z - image->at.z),
                          two * gx, two * gy, two * gz, layers->inverse};
}

/* Pressure term of the image of j; a push never becomes a pull. */
SIMD_INLINE f8 image_term(const DensitySlope rise, f8 term, Separation d)
{
    const f8 zero = f8_splat(0), share = lesser(greater(term * rise.inverse_layer, zero), f8_splat(1));
    const f8 more = rise.g0 + rise.gx * d.x + rise.gy * d.y + rise.gz * d.z;
    return greater(term + share * more, lesser(term, zero));
}

/* Sources of neighbour searches in the additional sums of wcsph: particles and their wall images. For files
   compiled for each instruction set. */

/* The particles of a group, or an image of each particle. */
typedef struct SumPoint {
    LaneVector at, sign;
    bool image;
} SumPoint;

/* Fills in the seekers of a group, the particles first; returns their number. */
SIMD_INLINE int sum_points_of(const PairArgs *args, const WallsFar *far, size_t i, size_t begin, size_t end,
                              LaneImages *images)
{
    const f8 one = f8_splat(1);
    const bool has = images_of(args, far, i, begin, end, images);
    images->of[0] = (ImageParticle){place_of(args, i), {one, one, one}};
    return has ? images->count + 1 : 1;
}

SIMD_INLINE SumPoint sum_point_of(const LaneImages *images, int m)
{
    return (SumPoint){images->of[m].at, images->of[m].sign, m > 0};
}

/* Continuation of pressure from particles to images found; 0 for particles. */
SIMD_INLINE DensitySlope sum_point_slope(const PairArgs *args, size_t i, const SumPoint *from,
                                         const Layers *layers)
{
    const f8 zero = f8_splat(0);
    const ImageParticle image = {from->at, from->sign};
    return from->image ? rise_of(args, i, &image, layers) : (DensitySlope){zero, zero, zero, zero, zero};
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
SIMD_INLINE Symmetric mirrored(const Symmetric m, const LaneVector sign)
{
    return (Symmetric){
        m.xx, m.yy, m.zz, m.xy * sign.x * sign.y, m.yz * sign.y * sign.z, m.zx * sign.z * sign.x};
}

SIMD_INLINE LaneVector times(const Symmetric m, f8 x, f8 y, f8 z)
{
    return (LaneVector){m.xx * x + m.xy * y + m.zx * z, m.xy * x + m.yy * y + m.yz * z,
                        m.zx * x + m.yz * y + m.zz * z};
}

/* C of sim/methods/wcsph/wcsph_passes.c: for a group, and for its next neighbours. */
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
