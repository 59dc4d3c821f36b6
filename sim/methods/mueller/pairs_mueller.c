/* Pair sums of mueller. */
#include "sim/methods/mueller/mueller_private.h"

#include "sim/cpu/pair_loop.h"

/* The kernel's shape: poly6 = (1 - q^2)^3, spiky = (1 - q)^3, or the quintic spline. */
SIMD_INLINE f8 weight(f8 r2, f8 inverse_h, const DensityKernel kernel)
{
    if (kernel == DENSITY_QUINTIC)
        return height(f8_sqrt(r2) * inverse_h, KERNEL_QUINTIC);
    const f8 t = kernel == DENSITY_POLY6 ? f8_positive(f8_splat(1) - r2 * inverse_h * inverse_h)
                                         : closeness(f8_sqrt(r2) * inverse_h);
    return t * t * t;
}

/* Sum over neighbours, and over neighbours of the group's images, including the particles themselves. With
   `solids` also the part of boundary particles, whose place has the weight 1. */
SIMD_INLINE f8 density_of(const PairArgs *args, size_t i, const LaneImages *images,
                          const DensityKernel kernel, const bool solids, f8 *beside)
{
    const f8 inverse_h = f8_splat(1 / args->constants->support_radius),
             h2 = f8_splat(args->constants->support_radius * args->constants->support_radius);
    const LaneVector at = place_of(args, i);
    const NeighbourRange near = neighbour_range_of(args, i);
    f8 sum = f8_splat(0);
    NEIGHBOURS (near, j) {
        const f8x4 p = f8_load4(args->place, j);
        f8 w = weight(apart(at, p).r2, inverse_h, kernel);
        sum += w;
        if (solids)
            *beside += p.w * w;
        for (int m = 1; images && m <= images->count; m++) {
            const f8 r2 = apart(images->of[m].at, p).r2;
            if (i8_bits(r2 < h2) == 0)
                continue;
            w = weight(r2, inverse_h, kernel);
            sum += w;
            if (solids)
                *beside += p.w * w;
        }
    }
    if (images) {
        const SelfLanes own = themselves(args, i);
        for (int m = 1; m <= images->count; m++)
            sum += weight(separation(args, images->of[m].at, own.j).r2, inverse_h, kernel);
    }
    return sum;
}

/* sum W; Müller 2003, eq. 3 with unit mass (Solenthaler 2008). Scaled last. */
SIMD_INLINE void density_range(const PairArgs *args, size_t begin, size_t end, const DensityKernel kernel,
                               const bool solids)
{
    const f8 one = f8_splat(1), scale = f8_splat(args->constants->kernel_scale);
    const WallsFar far = out_of_sight(args->constants);
    LaneImages images;
    GROUPS (i, begin, end) {
        const bool mirrored = images_of(args, &far, i, begin, end, &images);
        f8 beside = f8_splat(0);
        const f8 sum = mirrored ? density_of(args, i, &images, kernel, solids, &beside)
                                : density_of(args, i, NULL, kernel, solids, &beside);
        lanes_store(args->number_density, i, begin, end, scale * (one + sum)); /* 1: the particle itself */
        if (solids)
            lanes_store(args->fx, i, begin, end, scale * beside);
    }
}

SIMD_INLINE void density_by(const PairArgs *args, size_t begin, size_t end, const bool solids)
{
    const DensityKernel kernel = mueller_constants(args->constants)->kernel;
    if (kernel == DENSITY_POLY6)
        density_range(args, begin, end, DENSITY_POLY6, solids);
    else if (kernel == DENSITY_QUINTIC)
        density_range(args, begin, end, DENSITY_QUINTIC, solids);
    else
        density_range(args, begin, end, DENSITY_SPIKY, solids);
}

PAIR_LOOP(mueller_density)
{
    if (args->own[BOUNDARY_MEAN])
        density_by(args, begin, end, true);
    else
        density_by(args, begin, end, false);
}

/* Force of pressure at distance r = q h over the distance; poly6 has the spiky slope. */
SIMD_INLINE f8 push_of(f8 scale, f8 q, f8 r, f8 terms, const bool smooth)
{
    const f8 t = closeness(q);
    return smooth ? scale * shape(q, KERNEL_QUINTIC) * terms : scale * (t * t) * terms / r;
}

/* Pressure of an image, in its particle's axes; an image that rounding puts on its neighbour exerts no
   force. */
SIMD_INLINE void push_by(const PairArgs *args, const ImageParticle *image, f8 pi, f8x4 near, LaneVector *sum,
                         const bool smooth)
{
    const Constants *s = args->constants;
    const float least = 1e-9f * s->support_radius; /* changes no bit of a larger r2 */
    const Separation d = apart(image->at, near);
    if (i8_bits(d.r2 < f8_splat(s->support_radius * s->support_radius)) == 0)
        return;
    const f8 r = f8_sqrt(d.r2 + f8_splat(least * least)), q = r * f8_splat(1 / s->support_radius);
    const f8 push = push_of(f8_splat(s->pressure_scale), q, r, pi + d.term, smooth);
    sum->x += image->sign.x * push * d.x;
    sum->y += image->sign.y * push * d.y;
    sum->z += image->sign.z * push * d.z;
}

/* Forces of pressure and viscosity, eq. 10 and 14. With volumes V = 1 / n instead of m / rho and the
   pressure terms p_i V_i^2 + p_j V_j^2 (the gradient of sum e(n_i), so that energy is conserved), the
   forces are symmetric for every density ratio. Eq. 10 has (p_i + p_j) / 2 instead, which gives half of
   grad p: p_j alone sums up to grad p, and p_i is there for symmetry only. */
SIMD_INLINE LaneVector force_of(const PairArgs *args, size_t i, const LaneImages *images,
                                const bool coincident, const bool viscous, const bool many, const bool smooth)
{
    const Constants *s = args->constants;
    const f8 inverse_h = f8_splat(1 / s->support_radius), pressure_scale = f8_splat(s->pressure_scale);
    const f8 viscosity_scale = f8_splat(s->viscosity_scale * (many ? 0.5f : s->viscosity[0]));
    const LaneVector at = place_of(args, i);
    const NeighbourRange near = neighbour_range_of(args, i);
    const f8 ui = f8_load(args->vx + i), vi = f8_load(args->vy + i), wi = f8_load(args->vz + i);
    const f8 pi = f8_load(args->pressure_term + i);
    const f8 mi = viscous && many ? f8_load(args->viscosity + i) : f8_splat(0);
    const f8 drag_scale = viscosity_scale * f8_load(args->volume + i);
    LaneVector sum = {f8_splat(0), f8_splat(0), f8_splat(0)};

    NEIGHBOURS (near, j) {
        const f8x4 p = f8_load4(args->place, j);
        Separation d = apart(at, p);
        if (coincident)
            d = separate(args, i, j, d);

        const f8 r = f8_sqrt(d.r2), q = r * inverse_h;
        const f8 push = push_of(pressure_scale, q, r, pi + d.term, smooth);
        sum.x += push * d.x;
        sum.y += push * d.y;
        sum.z += push * d.z;
        if (viscous) {
            const f8x4 v = motion(args, j);
            f8 drag = drag_scale * closeness(q) * v.w;
            if (many)
                drag *= pair_viscosities(args, mi, j);
            sum.x += drag * (v.x - ui);
            sum.y += drag * (v.y - vi);
            sum.z += drag * (v.z - wi);
        }
        for (int m = 1; images && m <= images->count; m++)
            push_by(args, &images->of[m], pi, p, &sum, smooth);
    }
    return sum;
}

/* For a group with coincident particles: a loop apart, since the test would cost the usual loop registers. */
static __attribute__((noinline)) LaneVector coincident_force(const PairArgs *args, size_t i,
                                                             const LaneImages *images, bool viscous,
                                                             bool many, bool smooth)
{
    return force_of(args, i, images, true, viscous, many, smooth);
}

SIMD_INLINE void force_range(const PairArgs *args, size_t begin, size_t end, const bool viscous,
                             const bool many, const bool smooth)
{
    const WallsFar far = out_of_sight(args->constants);
    LaneImages images;
    GROUPS (i, begin, end) {
        const SelfLanes own = themselves(args, i);
        const bool mirrored = images_of(args, &far, i, begin, end, &images);
        LaneVector sum;
        if (__builtin_expect(neighbour_range_of(args, i).coincident, 0))
            sum = coincident_force(args, i, mirrored ? &images : NULL, viscous, many, smooth);
        else
            sum = mirrored ? force_of(args, i, &images, false, viscous, many, smooth)
                           : force_of(args, i, NULL, false, viscous, many, smooth);
        for (int m = 1; mirrored && m <= images.count; m++)
            push_by(args, &images.of[m], f8_load(args->pressure_term + i), f8_load4(args->place, own.j), &sum,
                    smooth);
        lanes_store(args->fx, i, begin, end, sum.x);
        lanes_store(args->fy, i, begin, end, sum.y);
        lanes_store(args->fz, i, begin, end, sum.z);
    }
}

SIMD_INLINE void force_by(const PairArgs *args, size_t begin, size_t end, const bool smooth)
{
    if (!args->constants->rubs)
        force_range(args, begin, end, false, false, smooth);
    else if (!args->viscosity)
        force_range(args, begin, end, true, false, smooth);
    else
        force_range(args, begin, end, true, true, smooth);
}

PAIR_LOOP(mueller_force)
{
    if (mueller_constants(args->constants)->kernel == DENSITY_QUINTIC)
        force_by(args, begin, end, true);
    else
        force_by(args, begin, end, false);
}
