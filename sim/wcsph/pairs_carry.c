/* Velocity change by a shift: (shift . grad) v, sim/wcsph/carry.c. With y = M^-1 shift, M = sum F x_ij
   x_ij^T over fluid neighbours, the change is sum F (v_i - v_j) (x_ij . y). Exact for linear velocity, also
   at walls and surfaces, since images take no part. */
#include "sim/wcsph/pair_kernel.h"
#include "sim/wcsph/pair_matrix.h"

/* Sums of F x x^T, and of F x times velocity differences. */
typedef struct Slopes {
    Symmetric m;
    Place u, v, w;
} Slopes;

SIMD_INLINE Place plus(const Place a, f8 x, f8 y, f8 z, f8 times)
{
    return (Place){a.x + times * x, a.y + times * y, a.z + times * z};
}

SIMD_INLINE f8 dot(const Place a, const Place b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

SIMD_INLINE Slopes slopes_of(const PairArgs *args, size_t i, const ShapeKernel kernel)
{
    const Constants *s = args->constants;
    const float h = s->support_radius, least = 1e-6f * h;
    const f8 inverse_h = f8_splat(1 / h), least2 = f8_splat(least * least), zero = f8_splat(0);
    const f8 scale = f8_splat(wcsph_constants(s)->gradient_scale / s->rest_number_density),
             first_solid = f8_splat(FLUIDS_MAX);
    const Place at = place_of(args, i);
    const Near near = near_of(args, i);
    const f8 u = f8_load(args->vx + i), v = f8_load(args->vy + i), w = f8_load(args->vz + i);
    Slopes sum = {
        {zero, zero, zero, zero, zero, zero}, {zero, zero, zero}, {zero, zero, zero}, {zero, zero, zero}};
    NEIGHBOURS (near, j) {
        const Separation d = separation(args, at, j);
        const i8 fluid = (d.r2 >= least2) & (f8_gather(args->kind, j) < first_solid);
        const f8 f = scale * f8_masked(fluid, shape(f8_sqrt(d.r2) * inverse_h, kernel));
        const f8 x = f * d.x, y = f * d.y, z = f * d.z;
        const f8x4 other = motion(args, j);
        sum.m.xx += x * d.x, sum.m.yy += y * d.y, sum.m.zz += z * d.z;
        sum.m.xy += x * d.y, sum.m.yz += y * d.z, sum.m.zx += z * d.x;
        sum.u = plus(sum.u, x, y, z, u - other.x);
        sum.v = plus(sum.v, x, y, z, v - other.y);
        sum.w = plus(sum.w, x, y, z, w - other.z);
    }
    if (s->dimensions == 2)
        sum.m.zz = f8_splat(0.5f) * (sum.m.xx + sum.m.yy);
    return sum;
}

SIMD_INLINE void carry_range(const PairArgs *args, size_t begin, size_t end, const ShapeKernel kernel)
{
    GROUPS (i, begin, end) {
        const Place shift = {f8_load(args->own[UNEVEN] + i), f8_load(args->own[UNEVEN + 1] + i),
                             f8_load(args->own[UNEVEN + 2] + i)};
        const Slopes sum = slopes_of(args, i, kernel);
        const Place y = renormalise(sum.m, shift);
        lanes_store(args->own[CARRIED], i, begin, end, dot(y, sum.u));
        lanes_store(args->own[CARRIED + 1], i, begin, end, dot(y, sum.v));
        lanes_store(args->own[CARRIED + 2], i, begin, end, dot(y, sum.w));
    }
}

PAIR_LOOP(wcsph_carried)
{
    FOR_KERNEL(args, begin, end, carry_range);
}
