/* The pair loops of dfsph: see sim/dfsph/passes.h. */
#include "sim/incompressible/pairs.h"
#include "sim/dfsph/passes.h"

/* Of the number density, where `place` has 1 / m. */
PAIR_LOOP(dfsph_factor)
{
    density_sums(args, begin, end, dfsph_constants(args->constants)->gradient, args->own[SQUARES]);
}

PAIR_LOOP(dfsph_push)
{
    push_sums(args, begin, end, dfsph_constants(args->constants)->gradient, args->pressure_term);
}

/* sum F v_ij . x_ij of an image. */
SIMD_INLINE f8 rate_by(const PairArgs *args, const Mirrored *image, f8x4 vi, f8x4 near, f8x4 v)
{
    const Separation d = apart(args, image->at, near);
    return shape(image_q(args->constants, d.r2), DFSPH_KERNEL) *
           ((image->sign.x * vi.x - v.x) * d.x + (image->sign.y * vi.y - v.y) * d.y +
            (image->sign.z * vi.z - v.z) * d.z);
}

SIMD_INLINE f8 rate_of(const PairArgs *args, size_t i, const Near near, f8x4 vi, const Images *images)
{
    const f8 inverse_h = f8_splat(1 / args->constants->support_radius);
    const Place at = place_of(args, i);
    f8 sum = f8_splat(0);
    NEIGHBOURS (near, j) {
        const f8x4 p = f8_load4(args->place, j), v = motion(args, j);
        Separation d = apart(args, at, p);
        if (__builtin_expect(near.coincident, 0))
            d = separate_to(args, i, j, d, TWINS_PART);
        sum += shape(f8_sqrt(d.r2) * inverse_h, DFSPH_KERNEL) *
               ((vi.x - v.x) * d.x + (vi.y - v.y) * d.y + (vi.z - v.z) * d.z);
        for (int m = 1; images && m <= images->count; m++)
            sum += rate_by(args, &images->of[m], vi, p, v);
    }
    return sum;
}

/* -sum F v_ij . x_ij, with the velocities that `motion` has; of images the particles' own among them. */
PAIR_LOOP(dfsph_rate)
{
    const f8 gradient = f8_splat(dfsph_constants(args->constants)->gradient);
    const WallsFar far = out_of_sight(args->constants);
    Images images;
    GROUPS (i, begin, end) {
        const Themselves own = themselves(args, i);
        const f8x4 vi = motion(args, own.j);
        const bool mirrored = images_of(args, &far, i, begin, end, &images);
        f8 sum = !mirrored ? rate_of(args, i, near_of(args, i), vi, NULL)
                           : rate_of(args, i, near_of(args, i), vi, &images);
        for (int m = 1; m <= images.count; m++)
            sum += rate_by(args, &images.of[m], vi, f8_load4(args->place, own.j), vi);
        lanes_store(args->own[RESIDUAL], i, begin, end, -(gradient * sum));
    }
}

PAIR_LOOP(dfsph_friction)
{
    friction_sums(args, begin, end, dfsph_constants(args->constants)->friction_gradient);
}
