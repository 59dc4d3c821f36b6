/* What boundary particles of solids are to dfsph where they have multipliers: see sim/dfsph/passes.h. Both
   sums are of places and of velocities that a solver does not change: once a step. */
#include "sim/cpu/pair_images.h"
#include "sim/cpu/pair_loop.h"
#include "sim/cpu/pair_shape.h"
#include "sim/dfsph/passes.h"

/* Sums over boundary particles of F x, and of F v . x with their velocity. */
typedef struct Solid {
    f8 x, y, z, flow;
} Solid;

SIMD_INLINE void add_boundary(const PairArgs *args, const uint32_t *j, const Separation *d, const Place *sign,
                              Solid *sum)
{
    const f8 zero = f8_splat(0), q = f8_sqrt(d->r2) * f8_splat(1 / args->constants->support_radius);
    const i8 solid = f8_gather(args->own[INVERSE_MASS], j) == zero;
    const f8 f = f8_masked(solid, shape(q, DFSPH_KERNEL));
    const f8x4 v = motion(args, j);
    sum->x += sign->x * f * d->x;
    sum->y += sign->y * f * d->y;
    sum->z += sign->z * f * d->z;
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

PAIR_LOOP(dfsph_solids)
{
    const WallsFar far = out_of_sight(args->constants);
    const f8 gradient = f8_splat(dfsph_constants(args->constants)->gradient), one = f8_splat(1),
             zero = f8_splat(0);
    const Place unturned = {one, one, one};
    GROUPS (i, begin, end) {
        const Place at = place_of(args, i);
        const Near near = near_of(args, i);
        Solid sum = {zero, zero, zero, zero};
        NEIGHBOURS (near, j) {
            Separation d = separation(args, at, j);
            if (__builtin_expect(near.coincident, 0))
                d = separate_to(args, i, j, d, TWINS_PART);
            add_boundary(args, j, &d, &unturned, &sum);
        }
        add_images(args, &far, i, begin, end, &sum);
        lanes_store(args->own[SOLID_SLOPE], i, begin, end, gradient * sum.x);
        lanes_store(args->own[SOLID_SLOPE + 1], i, begin, end, gradient * sum.y);
        lanes_store(args->own[SOLID_SLOPE + 2], i, begin, end, gradient * sum.z);
        lanes_store(args->own[SOLID_FLOW], i, begin, end, gradient * sum.flow);
    }
}
