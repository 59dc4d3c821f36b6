/* Additional sums of wcsph for interfaces between fluids with a high density contrast. With t = p V^2 and
   w_ij = 1 - 4 rho_i / rho_j if the rest density of j is more than 4 times that of i, w_ji = -w_ij:
     force_i += sum w_ij (t_i - t_j) F x_ij, so a pair has (1 + w) t_i + (1 - w) t_j;
     d rho_i / dt += (rho0_i / n0) (-sum w_ij F v_ij . x_ij), with the force as adjoint.
   Momentum and energy remain conserved. With corrected gradients, x_ij becomes (1 + C) x_ij with the C of
   the particle of t or of the rate.

   With t_i + t_j alone, a pressure that hardly moves heavy particles throws light particles. With w, light
   particles move at most 4 times as much as within their own fluid, and the step of a single fluid is
   stable. After: X. Y. Hu, N. A. Adams, "An incompressible multi-phase SPH method", 2007, eq. 13, with w =
   (rho_j - rho_i) / (rho_i + rho_j): the pressure that accelerates both sides alike.

   The rate uses v_i minus the velocity of an interface with the inertia of both fluids. The rate mistakes
   stretching along the interface for contraction, and waves between fluids of 2 : 1 would grow 2 % more
   slowly. So w begins at a contrast of 4. */
#include "sim/wcsph/pair_seeker.h"

/* w of a group and its next neighbours, from their rest densities; 0 with solids, which have no rest
   density. */
SIMD_INLINE f8 contrast(f8 mine, f8 theirs)
{
    const f8 light = lesser(mine, theirs),
             w = f8_splat(1) - f8_splat(CONTRAST_LEAST) * light / greater(mine, theirs);
    return f8_masked((light > f8_splat(0)) & (w > f8_splat(0)), f8_select(mine < theirs, w, -w));
}

/* x and C x. */
SIMD_INLINE Place whole(const Symmetric c, const Place x)
{
    const Place more = times(c, x.x, x.y, x.z);
    return (Place){x.x + more.x, x.y + more.y, x.z + more.z};
}

/* Sums of w F x_ij and w t_j (1 + C_j) F x_ij. */
typedef struct Between {
    Place here, there;
} Between;

SIMD_INLINE void between(const PairArgs *args, const Near near, const Seeker *from, f8 density,
                         const Rise *rise, const ShapeKernel kernel, const bool corrected, Between *sum)
{
    NEIGHBOURS (near, j) {
        const f8 w = contrast(density, f8_gather(args->own[REST_DENSITY], j));
        if (i8_bits(w != f8_splat(0)) == 0)
            continue;
        const Separation d = separation(args, from->at, j);
        const f8 f = w * weight_of(args, d.r2, from->image, kernel);
        const f8 push = f * (from->image ? image_term(*rise, d.term, d) : d.term);
        Place x = {d.x, d.y, d.z};
        if (corrected)
            x = whole(correction_there(args, j), x);
        sum->here.x += f * d.x, sum->here.y += f * d.y, sum->here.z += f * d.z;
        sum->there.x += push * x.x, sum->there.y += push * x.y, sum->there.z += push * x.z;
    }
}

SIMD_INLINE void push_of(const PairArgs *args, size_t i, size_t begin, size_t end, const Seeker *from,
                         const Layers *layers, const ShapeKernel kernel, const bool corrected)
{
    const f8 zero = f8_splat(0), pi = f8_load(args->pressure_term + i);
    const f8 gradient = f8_splat(wcsph_constants(args->constants)->gradient_scale);
    const Rise rise = seeker_rise(args, i, from, layers);
    Between sum = {{zero, zero, zero}, {zero, zero, zero}};
    between(args, near_of(args, i), from, f8_load(args->own[REST_DENSITY] + i), &rise, kernel, corrected,
            &sum);
    const Place here = corrected ? whole(mirrored(correction_of(args, i), from->sign), sum.here) : sum.here;
    lanes_add(args->fx, i, begin, end, from->sign.x * gradient * (pi * here.x - sum.there.x));
    lanes_add(args->fy, i, begin, end, from->sign.y * gradient * (pi * here.y - sum.there.y));
    lanes_add(args->fz, i, begin, end, from->sign.z * gradient * (pi * here.z - sum.there.z));
}

SIMD_INLINE void push_range(const PairArgs *args, size_t begin, size_t end, const ShapeKernel kernel)
{
    const WallsFar far = out_of_sight(args->constants);
    const f8 zero = f8_splat(0);
    const Layers none = {{zero, zero, zero}, zero};
    Images images;
    GROUPS (i, begin, end) {
        const int count = seekers_of(args, &far, i, begin, end, &images);
        const Layers layers = count > 1 ? layers_of(args, i, begin, end) : none;
        for (int m = 0; m < count; m++) {
            const Seeker from = seeker_of(&images, m);
            if (args->own[CORRECTION])
                push_of(args, i, begin, end, &from, &layers, kernel, true);
            else
                push_of(args, i, begin, end, &from, &layers, kernel, false);
        }
    }
}

/* Sum of w F v_ij . (1 + C_i) x_ij. */
SIMD_INLINE f8 between_flow(const PairArgs *args, size_t i, const Seeker *from, const ShapeKernel kernel,
                            const bool corrected)
{
    const Near near = near_of(args, i);
    const f8 density = f8_load(args->own[REST_DENSITY] + i), zero = f8_splat(0);
    const Place v = {from->sign.x * f8_load(args->vx + i), from->sign.y * f8_load(args->vy + i),
                     from->sign.z * f8_load(args->vz + i)};
    Symmetric c = {zero, zero, zero, zero, zero, zero};
    if (corrected)
        c = mirrored(correction_of(args, i), from->sign);
    f8 sum = zero;
    NEIGHBOURS (near, j) {
        const f8 w = contrast(density, f8_gather(args->own[REST_DENSITY], j));
        if (i8_bits(w != zero) == 0)
            continue;
        const Separation d = separation(args, from->at, j);
        const f8 f = w * weight_of(args, d.r2, from->image, kernel);
        const f8x4 u = motion(args, j);
        Place x = {d.x, d.y, d.z};
        if (corrected)
            x = whole(c, x);
        sum += f * ((v.x - u.x) * x.x + (v.y - u.y) * x.y + (v.z - u.z) * x.z);
    }
    return sum;
}

SIMD_INLINE void rate_range(const PairArgs *args, size_t begin, size_t end, const ShapeKernel kernel)
{
    const f8 gradient = f8_splat(wcsph_constants(args->constants)->gradient_scale);
    const WallsFar far = out_of_sight(args->constants);
    Images images;
    GROUPS (i, begin, end) {
        const int count = seekers_of(args, &far, i, begin, end, &images);
        f8 sum = f8_splat(0);
        for (int m = 0; m < count; m++) {
            const Seeker from = seeker_of(&images, m);
            sum += args->own[CORRECTION] ? between_flow(args, i, &from, kernel, true)
                                         : between_flow(args, i, &from, kernel, false);
        }
        lanes_add(args->fx, i, begin, end, -(gradient * sum));
    }
}

PAIR_LOOP(wcsph_interface_rate)
{
    FOR_KERNEL(args, begin, end, rate_range);
}

PAIR_LOOP(wcsph_interface_force)
{
    FOR_KERNEL(args, begin, end, push_range);
}
