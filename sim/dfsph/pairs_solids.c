/* Sums over boundary particles of solids for dfsph, with multipliers: see sim/dfsph/passes.h. The solvers
   change neither the positions nor the velocities in the sums: once a step is enough. */
#include "sim/cpu/pair_images.h"
#include "sim/cpu/pair_loop.h"
#include "sim/cpu/pair_shape.h"
#include "sim/dfsph/passes.h"

/* Sums over boundary particles of F x, of F x x^T, and of F v . x with the velocity v of a boundary
   particle. */
typedef struct Solid {
    f8 x, y, z, xx, yy, zz, xy, yz, zx, flow;
} Solid;

SIMD_INLINE void add_boundary(const PairArgs *args, const uint32_t *j, const Separation *d, const Place *sign,
                              Solid *sum)
{
    const f8 zero = f8_splat(0), q = f8_sqrt(d->r2) * f8_splat(1 / args->constants->support_radius);
    const i8 solid = f8_gather(args->own[INVERSE_MASS], j) == zero;
    const f8 f =
        f8_masked(solid, f8_splat(dfsph_constants(args->constants)->gradient) * shape(q, DFSPH_KERNEL));
    const f8x4 v = motion(args, j);
    const f8 x = sign->x * d->x, y = sign->y * d->y, z = sign->z * d->z, fx = f * x, fy = f * y, fz = f * z;
    sum->x += fx, sum->y += fy, sum->z += fz;
    sum->xx += fx * x, sum->yy += fy * y, sum->zz += fz * z;
    sum->xy += fx * y, sum->yz += fy * z, sum->zx += fz * x;
    sum->flow += f * (v.x * d->x + v.y * d->y + v.z * d->z);
}

SIMD_INLINE void add_images(const PairArgs *args, const WallsFar *far, size_t i, size_t begin, size_t end,
                            Solid *sum)
{
    const Near near = near_of(args, i);
    Images images;
    if (!images_of(args, far, i, begin, end, &images))
        return;
    for (int m = 1; m <= images.count; m++) {
        const Mirrored image = images.of[m];
        NEIGHBOURS (near, j) {
            const Separation d = separation(args, image.at, j);
            add_boundary(args, j, &d, &image.sign, sum);
        }
    }
}

/* The mean of F y^2 over directions y along the solid: across sum F x. */
SIMD_INLINE f8 along(const Solid *sum, float dimensions)
{
    const f8 x = sum->x, y = sum->y, z = sum->z, square = x * x + y * y + z * z, two = f8_splat(2),
             across = x * x * sum->xx + y * y * sum->yy + z * z * sum->zz +
                      two * (x * y * sum->xy + y * z * sum->yz + z * x * sum->zx),
             all = sum->xx + sum->yy + sum->zz;
    return f8_masked(square > f8_splat(0), all - across / greater(square, f8_splat(1e-30f))) *
           f8_splat(1 / (dimensions - 1));
}

PAIR_LOOP(dfsph_solids)
{
    const WallsFar far = out_of_sight(args->constants);
    const f8 one = f8_splat(1), zero = f8_splat(0),
             share = f8_splat(args->constants->rest_number_density /
                              dfsph_constants(args->constants)->pressure_of_term);
    const Place unturned = {one, one, one};
    GROUPS (i, begin, end) {
        const Place at = place_of(args, i);
        const Near near = near_of(args, i);
        Solid sum = {zero, zero, zero, zero, zero, zero, zero, zero, zero, zero};
        NEIGHBOURS (near, j) {
            Separation d = separation(args, at, j);
            if (__builtin_expect(near.coincident, 0))
                d = separate_to(args, i, j, d, TWINS_PART);
            add_boundary(args, j, &d, &unturned, &sum);
        }
        add_images(args, &far, i, begin, end, &sum);
        lanes_store(args->own[SOLID_SLOPE], i, begin, end, sum.x);
        lanes_store(args->own[SOLID_SLOPE + 1], i, begin, end, sum.y);
        lanes_store(args->own[SOLID_SLOPE + 2], i, begin, end, sum.z);
        lanes_store(args->own[SOLID_FLOW], i, begin, end, sum.flow);
        lanes_store(args->own[SOLID_SHARE], i, begin, end,
                    share * along(&sum, (float)args->constants->dimensions));
    }
}
