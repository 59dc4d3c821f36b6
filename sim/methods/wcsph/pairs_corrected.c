/* Additional sums of wcsph for corrected gradients: sim/methods/wcsph/wcsph_passes.c. C = 0 adds nothing.
     M_i = V_i sum F x_ij x_ij^T, which is 1 on the lattice and includes images and solids;
     d rho_i / dt += (rho0_i / n0) (-sum F v_ij . C_i x_ij);
     force_i += sum (p_i V_i^2 C_i + p_j V_j^2 C_j) F x_ij, the adjoint of that rate;
     uneven_i += sum (S_i + S_j) / 2 F x_ij, S = n0^2 V^2 (1 + C) - 1.
   Shifts use the sum of uneven plus the plain sum of F x_ij: together the push of a uniform pressure, so
   that particles become as dense as the flow. A particle's image has the mirrored C; boundary particles of
   solids have C = 0 and V0. */
#include "sim/methods/wcsph/pair_wcsph.h"

SIMD_INLINE void spread(const PairArgs *args, const NeighbourRange near, const SumPoint *from,
                        const ShapeKernel kernel, Symmetric *m)
{
    NEIGHBOURS (near, j) {
        const Separation d = separation(args, from->at, j);
        const f8 f = weight_of(args, d.r2, from->image, kernel);
        const f8 fx = f * d.x, fy = f * d.y, fz = f * d.z;
        m->xx += fx * d.x, m->yy += fy * d.y, m->zz += fz * d.z;
        m->xy += fx * d.y, m->yz += fy * d.z, m->zx += fz * d.x;
    }
}

SIMD_INLINE void add_mirrored(Symmetric *sum, const Symmetric m, const LaneVector sign)
{
    const Symmetric own = mirrored(m, sign);
    sum->xx += own.xx, sum->yy += own.yy, sum->zz += own.zz;
    sum->xy += own.xy, sum->yz += own.yz, sum->zx += own.zx;
}

/* M / (n0 V_i), from which sim/methods/wcsph/wcsph_passes.c makes C. */
SIMD_INLINE void matrix_range(const PairArgs *args, size_t begin, size_t end, const ShapeKernel kernel)
{
    const Constants *s = args->constants;
    const f8 scale = f8_splat(wcsph_constants(s)->gradient_scale / s->rest_number_density),
             zero = f8_splat(0);
    const WallsFar far = out_of_sight(s);
    LaneImages images;
    GROUPS (i, begin, end) {
        const int count = sum_points_of(args, &far, i, begin, end, &images);
        const SelfLanes own = themselves(args, i);
        Symmetric sum = {zero, zero, zero, zero, zero, zero};
        for (int m = 0; m < count; m++) {
            const SumPoint from = sum_point_of(&images, m);
            Symmetric found = {zero, zero, zero, zero, zero, zero};
            spread(args, neighbour_range_of(args, i), &from, kernel, &found);
            if (m > 0)
                spread(args, neighbours_of_own_lanes(&own), &from, kernel, &found);
            add_mirrored(&sum, found, from.sign);
        }
        const f8 entries[6] = {sum.xx, sum.yy, sum.zz, sum.xy, sum.yz, sum.zx};
        for (int k = 0; k < 6; k++)
            lanes_store(args->own[CORRECTION + k], i, begin, end, scale * entries[k]);
    }
}

/* Sum of F v_ij . C_i x_ij, in the mirror's axes. */
SIMD_INLINE f8 corrected_flow(const PairArgs *args, const NeighbourRange near, const SumPoint *from,
                              const LaneVector v, const Symmetric c, const ShapeKernel kernel)
{
    f8 sum = f8_splat(0);
    NEIGHBOURS (near, j) {
        const Separation d = separation(args, from->at, j);
        const f8 f = weight_of(args, d.r2, from->image, kernel);
        const f8x4 u = motion(args, j);
        const LaneVector cd = times(c, d.x, d.y, d.z);
        sum += f * ((v.x - u.x) * cd.x + (v.y - u.y) * cd.y + (v.z - u.z) * cd.z);
    }
    return sum;
}

SIMD_INLINE void rate_range(const PairArgs *args, size_t begin, size_t end, const ShapeKernel kernel)
{
    const f8 gradient = f8_splat(wcsph_constants(args->constants)->gradient_scale);
    const WallsFar far = out_of_sight(args->constants);
    LaneImages images;
    GROUPS (i, begin, end) {
        const int count = sum_points_of(args, &far, i, begin, end, &images);
        const SelfLanes own = themselves(args, i);
        const Symmetric c = correction_of(args, i);
        f8 sum = f8_splat(0);
        for (int m = 0; m < count; m++) {
            const SumPoint from = sum_point_of(&images, m);
            const Symmetric cm = mirrored(c, from.sign);
            const LaneVector v = {from.sign.x * f8_load(args->vx + i), from.sign.y * f8_load(args->vy + i),
                                  from.sign.z * f8_load(args->vz + i)};
            sum += corrected_flow(args, neighbour_range_of(args, i), &from, v, cm, kernel);
            if (m > 0)
                sum += corrected_flow(args, neighbours_of_own_lanes(&own), &from, v, cm, kernel);
        }
        lanes_add(args->fx, i, begin, end, -(gradient * sum));
    }
}

/* Sums of F x_ij, of p_j V_j^2 C_j F x_ij and, for shifts, of S_j F x_ij. */
typedef struct Pushed {
    LaneVector even, there, shift;
} Pushed;

/* (n0 V)^2, with V at most the value at THINNEST; 1 for boundary particles without friction, whose V is 0. */
SIMD_INLINE f8 volume_squared(const PairArgs *args, f8 volume)
{
    const float n0 = args->constants->rest_number_density;
    const f8 v = f8_splat(n0) * lesser(volume, f8_splat(1 / (THINNEST * n0)));
    return f8_select(volume > f8_splat(0), v * v, f8_splat(1));
}

/* S x, with c = C x. */
SIMD_INLINE LaneVector evened(f8 v2, f8 x, f8 y, f8 z, const LaneVector c)
{
    const f8 more = v2 - f8_splat(1);
    return (LaneVector){more * x + v2 * c.x, more * y + v2 * c.y, more * z + v2 * c.z};
}

SIMD_INLINE void corrected_push(const PairArgs *args, const NeighbourRange near, const SumPoint *from,
                                const DensitySlope *rise, const ShapeKernel kernel, const bool shifts,
                                Pushed *sum)
{
    NEIGHBOURS (near, j) {
        const Separation d = separation(args, from->at, j);
        const f8 f = weight_of(args, d.r2, from->image, kernel);
        const f8 push = f * (from->image ? image_term(*rise, d.term, d) : d.term);
        const LaneVector c = times(correction_there(args, j), d.x, d.y, d.z);
        sum->even.x += f * d.x, sum->even.y += f * d.y, sum->even.z += f * d.z;
        if (shifts) {
            const LaneVector more = evened(volume_squared(args, motion(args, j).w), d.x, d.y, d.z, c);
            sum->shift.x += f * more.x, sum->shift.y += f * more.y, sum->shift.z += f * more.z;
        }
        sum->there.x += push * c.x, sum->there.y += push * c.y, sum->there.z += push * c.z;
    }
}

SIMD_INLINE void shift_by(const PairArgs *args, size_t i, size_t begin, size_t end, const LaneVector sign,
                          const Pushed *sum, const LaneVector corrected)
{
    const f8 half = f8_splat(0.5f * wcsph_constants(args->constants)->gradient_scale);
    const f8 v2 = volume_squared(args, f8_load(args->volume + i));
    const LaneVector here = evened(v2, sum->even.x, sum->even.y, sum->even.z, corrected);
    lanes_add(args->own[UNEVEN], i, begin, end, sign.x * half * (here.x + sum->shift.x));
    lanes_add(args->own[UNEVEN + 1], i, begin, end, sign.y * half * (here.y + sum->shift.y));
    lanes_add(args->own[UNEVEN + 2], i, begin, end, sign.z * half * (here.z + sum->shift.z));
}

SIMD_INLINE void push_of(const PairArgs *args, size_t i, size_t begin, size_t end, const SumPoint *from,
                         const Layers *layers, const ShapeKernel kernel, const bool shifts)
{
    const f8 zero = f8_splat(0), pi = f8_load(args->pressure_term + i);
    const f8 gradient = f8_splat(wcsph_constants(args->constants)->gradient_scale);
    const SelfLanes own = themselves(args, i);
    const DensitySlope rise = sum_point_slope(args, i, from, layers);
    Pushed sum = {{zero, zero, zero}, {zero, zero, zero}, {zero, zero, zero}};
    corrected_push(args, neighbour_range_of(args, i), from, &rise, kernel, shifts, &sum);
    if (from->image)
        corrected_push(args, neighbours_of_own_lanes(&own), from, &rise, kernel, shifts, &sum);
    const LaneVector here =
        times(mirrored(correction_of(args, i), from->sign), sum.even.x, sum.even.y, sum.even.z);
    lanes_add(args->fx, i, begin, end, from->sign.x * gradient * (pi * here.x + sum.there.x));
    lanes_add(args->fy, i, begin, end, from->sign.y * gradient * (pi * here.y + sum.there.y));
    lanes_add(args->fz, i, begin, end, from->sign.z * gradient * (pi * here.z + sum.there.z));
    if (shifts)
        shift_by(args, i, begin, end, from->sign, &sum, here);
}

SIMD_INLINE void push_range(const PairArgs *args, size_t begin, size_t end, const ShapeKernel kernel,
                            const bool shifts)
{
    const WallsFar far = out_of_sight(args->constants);
    const f8 zero = f8_splat(0);
    const Layers none = {{zero, zero, zero}, zero};
    LaneImages images;
    GROUPS (i, begin, end) {
        const int count = sum_points_of(args, &far, i, begin, end, &images);
        const Layers layers = count > 1 ? layers_of(args, i, begin, end) : none;
        for (int m = 0; m < count; m++) {
            const SumPoint from = sum_point_of(&images, m);
            push_of(args, i, begin, end, &from, &layers, kernel, shifts);
        }
    }
}

SIMD_INLINE void force_of(const PairArgs *args, size_t begin, size_t end, const ShapeKernel kernel)
{
    if (args->own[UNEVEN])
        push_range(args, begin, end, kernel, true);
    else
        push_range(args, begin, end, kernel, false);
}

PAIR_LOOP(wcsph_matrix)
{
    FOR_KERNEL(args, begin, end, matrix_range);
}

PAIR_LOOP(wcsph_corrected_rate)
{
    FOR_KERNEL(args, begin, end, rate_range);
}

PAIR_LOOP(wcsph_corrected_force)
{
    FOR_KERNEL(args, begin, end, force_of);
}
