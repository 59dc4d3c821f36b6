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
        const f8 ki = f8_load4(args->place, themselves(args, i).j).w;
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

/* The solvers change neither the positions nor the velocities in these sums: once a step is enough. */
PAIR_LOOP(dfsph_solids)
{
    const DfsphBlock *own = dfsph_constants(args->constants);
    solid_sums(args, begin, end, own->gradient, 1 / own->pressure_of_term, args->own + SOLID,
               args->own[SOLID_FLOW]);
}
