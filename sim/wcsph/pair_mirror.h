/* Weights of wall images in the sums of wcsph, and continuation of pressure behind walls. For files
   compiled for each instruction set. */
#ifndef SLOSH_PAIR_MIRROR_H
#define SLOSH_PAIR_MIRROR_H

#include "sim/cpu/pair_images.h"
#include "sim/wcsph/pair_kernel.h"

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
typedef struct Rise {
    f8 g0, gx, gy, gz, inverse_layer;
} Rise;

/* Weight of a layer under gravity: per particle of a group rho0 V0^2 g, and 1 over its length times the
   spacing. */
typedef struct Layers {
    Place pull;
    f8 inverse;
} Layers;

static __attribute__((unused)) Layers layers_of(const PairArgs *args, size_t i, size_t begin, size_t end)
{
    const Constants *s = args->constants;
    float pull[3][LANES] = {{0}}, inverse[LANES] = {0};
    for (size_t k = 0; k < LANES; k++) {
        if (i + k < begin || i + k >= end)
            continue;
        const float x[3] = {args->x[i + k], args->y[i + k], args->z[i + k]};
        float g[3];
        apparent_gravity_at(args->gravity, x, g);
        const float weight = s->density[args->fluid[i + k]] /
                             (s->rest_number_density * s->rest_number_density); /* rho0 V0^2 */
        const float layer = weight * s->spacing * sqrtf(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
        for (int a = 0; a < 3; a++)
            pull[a][k] = weight * g[a];
        inverse[k] = layer > 0 ? 1 / layer : 0;
    }
    return (Layers){{f8_load(pull[0]), f8_load(pull[1]), f8_load(pull[2])}, f8_load(inverse)};
}

static __attribute__((unused)) Rise rise_of(const PairArgs *args, size_t i, const Mirrored *image,
                                            const Layers *layers)
{
    const f8 zero = f8_splat(0), two = f8_splat(2);
    const Place x = place_of(args, i);
    const f8 gx = f8_masked(image->sign.x < zero, layers->pull.x),
             gy = f8_masked(image->sign.y < zero, layers->pull.y),
             gz = f8_masked(image->sign.z < zero, layers->pull.z);
    return (Rise){gx * (x.x - image->at.x) + gy * (x.y - image->at.y) + gz * (x.z - image->at.z), two * gx,
                  two * gy, two * gz, layers->inverse};
}

/* Pressure term of the image of j; a push never becomes a pull. */
SIMD_INLINE f8 image_term(const Rise rise, f8 term, Separation d)
{
    const f8 zero = f8_splat(0), share = lesser(greater(term * rise.inverse_layer, zero), f8_splat(1));
    const f8 more = rise.g0 + rise.gx * d.x + rise.gy * d.y + rise.gz * d.z;
    return greater(term + share * more, lesser(term, zero));
}

#endif
