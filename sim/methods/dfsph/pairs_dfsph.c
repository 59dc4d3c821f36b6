/* The pair loops of dfsph: see sim/methods/dfsph/dfsph.h. */
#include "sim/methods/dfsph/dfsph_private.h"

#include "sim/cpu/pair_loop.h"
#include "sim/methods/shared/pair_incompressible.h"

/* Sums of the number density; `place` has 1 / m. */
PAIR_LOOP(dfsph_factor)
{
    density_sums(args, begin, end, dfsph_constants(args->constants)->gradient, args->own[SQUARES],
                 args->own[LACK]);
}

/* sum (k_i + k_j) F x_ij; `place` has k. */
PAIR_LOOP(dfsph_push)
{
    const f8 gradient = f8_splat(dfsph_constants(args->constants)->gradient), zero = f8_splat(0);
    GROUPS (i, begin, end) {
        const f8 ki = f8_load(args->pressure_term + i);
        LaneVector sum = {zero, zero, zero};
        push_of(args, i, neighbour_range_of(args, i), ki, NULL, &sum);
        for (const uint32_t *at = first_image(args, i); at;) {
            ImageParticle image;
            NeighbourRange near;
            at = next_image(at, &image, &near);
            NEIGHBOURS (near, j)
                push_by(args, &image, ki, f8_load4(args->place, j), &sum);
        }
        lanes_store(args->fx, i, begin, end, gradient * sum.x);
        lanes_store(args->fy, i, begin, end, gradient * sum.y);
        lanes_store(args->fz, i, begin, end, gradient * sum.z);
    }
}

/* sum F v_ij . x_ij of an image. */
SIMD_INLINE f8 rate_by(const PairArgs *args, const ImageParticle *image, f8x4 vi, f8x4 near, f8x4 v)
{
    const Separation d = apart(image->at, near);
    return shape(image_q(args->constants, d.r2), DFSPH_KERNEL) *
           ((image->sign.x * vi.x - v.x) * d.x + (image->sign.y * vi.y - v.y) * d.y +
            (image->sign.z * vi.z - v.z) * d.z);
}

SIMD_INLINE f8 rate_of(const PairArgs *args, size_t i, const NeighbourRange near, f8x4 vi)
{
    const f8 inverse_h = f8_splat(1 / args->constants->support_radius);
    const LaneVector at = place_of(args, i);
    f8 sum = f8_splat(0);
    NEIGHBOURS (near, j) {
        const f8x4 p = f8_load4(args->place, j), v = motion(args, j);
        Separation d = apart(at, p);
        if (__builtin_expect(near.coincident, 0))
            d = separate_to(args, i, j, d, TWINS_PART);
        sum += shape(f8_sqrt(d.r2) * inverse_h, DFSPH_KERNEL) *
               ((vi.x - v.x) * d.x + (vi.y - v.y) * d.y + (vi.z - v.z) * d.z);
    }
    return sum;
}

/* -sum F v_ij . x_ij, with velocities from `motion`; images include those of the particles themselves. */
PAIR_LOOP(dfsph_rate)
{
    const f8 gradient = f8_splat(dfsph_constants(args->constants)->gradient);
    GROUPS (i, begin, end) {
        const SelfLanes own = themselves(args, i);
        const f8x4 vi = motion(args, own.j);
        f8 sum = rate_of(args, i, neighbour_range_of(args, i), vi);
        for (const uint32_t *at = first_image(args, i); at;) {
            ImageParticle image;
            NeighbourRange near;
            at = next_image(at, &image, &near);
            NEIGHBOURS (near, j)
                sum += rate_by(args, &image, vi, f8_load4(args->place, j), motion(args, j));
        }
        lanes_store(args->own[RESIDUAL], i, begin, end, -(gradient * sum));
    }
}

PAIR_LOOP(dfsph_friction)
{
    friction_sums(args, begin, end, dfsph_constants(args->constants)->friction_gradient);
}

/* Sums over boundary particles of solids for dfsph, with multipliers: see sim/methods/dfsph/dfsph.h. The
   solvers change neither the positions nor the velocities in the sums: once a step is enough. */

/* Sums over boundary particles of F x, of F x x^T, and of F v . x with the velocity v of a boundary
   particle. */
typedef struct SolidSums {
    f8 x, y, z, xx, yy, zz, xy, yz, zx, flow;
} SolidSums;

SIMD_INLINE void add_boundary(const PairArgs *args, const uint32_t *j, const Separation *d,
                              const LaneVector *sign, SolidSums *sum)
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
                            SolidSums *sum)
{
    const NeighbourRange near = neighbour_range_of(args, i);
    LaneImages images;
    if (!images_of(args, far, i, begin, end, &images))
        return;
    for (int m = 1; m <= images.count; m++) {
        const ImageParticle image = images.of[m];
        NEIGHBOURS (near, j) {
            const Separation d = separation(args, image.at, j);
            add_boundary(args, j, &d, &image.sign, sum);
        }
    }
}

/* The mean of F y^2 over directions y along the solid: across sum F x. */
SIMD_INLINE f8 along(const SolidSums *sum, float dimensions)
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
    const LaneVector unturned = {one, one, one};
    GROUPS (i, begin, end) {
        const LaneVector at = place_of(args, i);
        const NeighbourRange near = neighbour_range_of(args, i);
        SolidSums sum = {zero, zero, zero, zero, zero, zero, zero, zero, zero, zero};
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
