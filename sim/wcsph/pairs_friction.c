/* Additional friction in the radial form for corrected gradients, where neighbours are missing. A
   particle's friction is scaled by 1 + tr C / d, which is 1 over the filled share of the surrounding space;
   a pair uses the mean of both scales. So a free surface also dissipates 2 mu D : D, and momentum is
   conserved. Images and solids have separate friction. */
#include "sim/wcsph/pair_kernel.h"

/* tr C / (2 d). */
SIMD_INLINE f8 half_of(f8 xx, f8 yy, f8 zz, int dimensions)
{
    return f8_splat(0.5f / (float)dimensions) * (xx + yy + zz);
}

SIMD_INLINE f8 half_there(const PairArgs *args, const uint32_t *j)
{
    float *const *c = args->own + CORRECTION;
    return half_of(f8_gather(c[0], j), f8_gather(c[1], j), f8_gather(c[2], j), args->constants->dimensions);
}

SIMD_INLINE void friction_range(const PairArgs *args, size_t begin, size_t end, const ShapeKernel kernel)
{
    const Constants *s = args->constants;
    const WcsphBlock *w = wcsph_constants(s);
    const float h = s->support_radius, least = 1e-6f * h;
    const f8 inverse_h = f8_splat(1 / h), least2 = f8_splat(least * least), zero = f8_splat(0);
    const f8 most = f8_splat(1 / (THINNEST * s->rest_number_density)), first_solid = f8_splat(FLUIDS_MAX),
             scale = f8_splat(w->gradient_scale * w->radial_friction);
    float *const *c = args->own + CORRECTION;

    GROUPS (i, begin, end) {
        const Place at = place_of(args, i);
        const Near near = near_of(args, i);
        const f8 u = f8_load(args->vx + i), v = f8_load(args->vy + i), z = f8_load(args->vz + i);
        const f8 volume = lesser(f8_load(args->volume + i), most),
                 mu = args->viscosity ? f8_load(args->viscosity + i) : f8_splat(s->viscosity[0]),
                 half = half_of(f8_load(c[0] + i), f8_load(c[1] + i), f8_load(c[2] + i), s->dimensions);
        Place sum = {zero, zero, zero};
        NEIGHBOURS (near, j) {
            const Separation d = separation(args, at, j);
            const i8 fluid = (d.r2 >= least2) & (f8_gather(args->kind, j) < first_solid);
            const f8 f = f8_masked(fluid, shape(f8_sqrt(d.r2) * inverse_h, kernel));
            const f8x4 other = motion(args, j);
            const f8 along = (other.x - u) * d.x + (other.y - v) * d.y + (other.z - z) * d.z;
            const f8 push = f * volume * lesser(other.w, most) * pair_viscosities(args, mu, j) *
                            (half + half_there(args, j)) * along;
            sum.x += push * d.x, sum.y += push * d.y, sum.z += push * d.z;
        }
        lanes_add(args->fx, i, begin, end, scale * sum.x);
        lanes_add(args->fy, i, begin, end, scale * sum.y);
        lanes_add(args->fz, i, begin, end, scale * sum.z);
    }
}

PAIR_LOOP(wcsph_corrected_friction)
{
    FOR_KERNEL(args, begin, end, friction_range);
}
