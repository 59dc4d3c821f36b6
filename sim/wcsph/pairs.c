/* The pair sums of wcsph. With grad W_ij = -F x_ij, x_ij = x_i - x_j, F = gradient f(r / h) >= 0:
     d rho_i / dt = (rho0_i / n0) (-sum F v_ij . x_ij)      the rate of number density, so that an interface
                                                            between fluids is none for it; Monaghan 1992
     force_i = sum (p_i V_i^2 + p_j V_j^2) F x_ij + ...      conserves the energy that goes with that rate */
#include "sim/wcsph/pair_kernel.h"

/* m^-1 b of the symmetric m = xx yy zz xy yz zx; 0 where det (3 m / trace) is below a quarter, since
   neighbours hardly span the space then: all around it is 1, in the lattice's own corner 0.77. */
static void renormalise(const float m[6], const float b[3], float out[3])
{
    const float cxx = m[1] * m[2] - m[4] * m[4], cyy = m[0] * m[2] - m[5] * m[5],
                czz = m[0] * m[1] - m[3] * m[3];
    const float cxy = m[4] * m[5] - m[3] * m[2], cyz = m[3] * m[5] - m[4] * m[0],
                czx = m[3] * m[4] - m[5] * m[1];
    const float det = m[0] * cxx + m[3] * cxy + m[5] * czx, mean = (m[0] + m[1] + m[2]) / 3;
    const float scale = det > 0.25f * (mean * mean * mean) ? 1 / det : 0;
    out[0] = scale * (cxx * b[0] + cxy * b[1] + czx * b[2]);
    out[1] = scale * (cxy * b[0] + cyy * b[1] + cyz * b[2]);
    out[2] = scale * (czx * b[0] + cyz * b[1] + czz * b[2]);
}

/* The gradient of relative density within a fluid, exact where that is linear: (sum F x x^T)^-1 sum F (e_i -
   e_j) x with x = x_ij (Antuono 2010, with volumes that are all the same). 0 next to solids: diffusion has to
   level the gaps that the fluid's order leaves there. */
SIMD_INLINE void slope_range(const PairArgs *args, size_t begin, size_t end, const ShapeKernel kernel)
{
    const Constants *s = args->constants;
    const WcsphBlock *w = wcsph_constants(s);
    const float h = s->support_radius, least = 1e-6f * h;
    const f8 inverse_h = f8_splat(1 / h), h2 = f8_splat(h * h), least2 = f8_splat(least * least);
    const float scale = w->gradient_scale / s->rest_number_density; /* m is 1 in the lattice */
    const f8 first_solid = f8_splat(FLUIDS_MAX);

    for (size_t i = begin; i < end; i++) {
        const Place at = place_of(args, i);
        const Near near = near_of(args, i);
        const f8 ri = f8_splat(args->own[RELATIVE][i]), fi = f8_splat(args->kind[i]);
        int solid = 0; /* whether a boundary particle is in reach */
        f8 xx = f8_splat(0), yy = xx, zz = xx, xy = xx, yz = xx, zx = xx, bx = xx, by = xx, bz = xx;

        NEIGHBOURS (near, j) {
            Separation d = separation(args, at, near, j);
            const i8 seen = d.r2 < h2;
            const f8 kind = f8_gather(args->kind, j);
            solid |= i8_bits(seen & (kind >= first_solid));
            const i8 same = seen & (d.r2 >= least2) & (kind == fi);
            const f8 f = f8_masked(same, shape(f8_sqrt(d.r2) * inverse_h, kernel));
            const f8 fx = f * d.x, fy = f * d.y, fz = f * d.z, de = ri - f8_gather(args->own[RELATIVE], j);
            xx += fx * d.x, yy += fy * d.y, zz += fz * d.z;
            xy += fx * d.y, yz += fy * d.z, zx += fz * d.x;
            bx += fx * de, by += fy * de, bz += fz * de;
        }
        float m[6] = {f8_sum(xx), f8_sum(yy), f8_sum(zz), f8_sum(xy), f8_sum(yz), f8_sum(zx)}, slope[3];
        const float b[3] = {scale * f8_sum(bx), scale * f8_sum(by), scale * f8_sum(bz)};
        for (int k = 0; k < 6; k++)
            m[k] *= scale;
        if (s->dimensions == 2)
            m[2] = 0.5f * (m[0] + m[1]);
        renormalise(m, b, slope);
        for (int k = 0; k < 3; k++)
            args->own[SLOPE + k][i] = solid ? 0 : slope[k];
    }
}

/* Sum of F v_ij . x_ij, the rate at which the flow draws together, less the diffusion of relative density
   within a fluid: what its differences have beyond its gradient (Molteni and Colagrossi 2009; Antuono 2010).
 */
SIMD_INLINE void rate_range(const PairArgs *args, size_t begin, size_t end, const ShapeKernel kernel,
                            const bool diffusive)
{
    const Constants *s = args->constants;
    const WcsphBlock *w = wcsph_constants(s);
    const float h = s->support_radius, least = 1e-6f * h;
    const f8 inverse_h = f8_splat(1 / h), least2 = f8_splat(least * least);
    const f8 diffusion = f8_splat(w->diffusion), half = f8_splat(0.5f);

    for (size_t i = begin; i < end; i++) {
        const Place at = place_of(args, i);
        const Near near = near_of(args, i);
        const f8 ui = f8_splat(args->vx[i]), vi = f8_splat(args->vy[i]), wi = f8_splat(args->vz[i]);
        const f8 ri = f8_splat(diffusive ? args->own[RELATIVE][i] : 0),
                 fi = f8_splat(diffusive ? args->kind[i] : 0);
        const f8 gx = f8_splat(diffusive ? args->own[SLOPE][i] : 0),
                 gy = f8_splat(diffusive ? args->own[SLOPE + 1][i] : 0),
                 gz = f8_splat(diffusive ? args->own[SLOPE + 2][i] : 0);
        f8 sum = f8_splat(0);

        NEIGHBOURS (near, j) {
            Separation d = separation(args, at, near, j);
            const f8 f = f8_masked(d.r2 >= least2, shape(f8_sqrt(d.r2) * inverse_h, kernel));
            const f8x4 v = motion(args, j);
            f8 flow = (ui - v.x) * d.x + (vi - v.y) * d.y + (wi - v.z) * d.z;
            if (diffusive) {
                const i8 same = f8_gather(args->kind, j) == fi;
                const f8 along = (gx + f8_gather(args->own[SLOPE], j)) * d.x +
                                 (gy + f8_gather(args->own[SLOPE + 1], j)) * d.y +
                                 (gz + f8_gather(args->own[SLOPE + 2], j)) * d.z;
                flow -= f8_masked(same, diffusion * (f8_gather(args->own[RELATIVE], j) - ri + half * along));
            }
            sum += f * flow;
        }
        args->fx[i] = -w->gradient_scale * f8_sum(sum);
    }
}

/* What has no column is the same for all. */
SIMD_INLINE f8 of_each(const float *column, f8 same, const uint32_t *j)
{
    return column ? f8_gather(column, j) : same;
}

/* Pressure; laminar viscosity (sim/matter/viscosity.h) or artificial one (Monaghan 1992, for pairs that part
   too): V_i V_j (mu_i + mu_j) F v_ji or V_i V_j (mu_i + mu_j) R F (v_ji . x_ij) x_ij, and -V_i V_j (a_i +
   a_j) (v_ij . x_ij) / (r^2 + h^2 / 400) F x_ij. With `shifts` what sim/wcsph/shift.c needs as well. */
SIMD_INLINE void wcsph_range(const PairArgs *args, size_t begin, size_t end, const ShapeKernel kernel,
                             const bool viscous, const bool radial, const bool artificial, const bool shifts)
{
    const Constants *s = args->constants;
    const WcsphBlock *w = wcsph_constants(s);
    const float h = s->support_radius;
    const f8 inverse_h = f8_splat(1 / h);
    const f8 soft = f8_splat(h * h / 400), scale = f8_splat(w->radial_friction);

    for (size_t i = begin; i < end; i++) {
        const Place at = place_of(args, i);
        const Near near = near_of(args, i);
        const f8 ui = f8_splat(args->vx[i]), vi = f8_splat(args->vy[i]), wi = f8_splat(args->vz[i]);
        const f8 pi = f8_splat(args->pressure_term[i]), volume = f8_splat(args->volume[i]);
        const f8 mi = f8_splat(args->viscosity ? args->viscosity[i] : s->viscosity[0]),
                 ai = f8_splat(args->own[ARTIFICIAL] ? args->own[ARTIFICIAL][i]
                                                     : w->wcsph_fluids[0].artificial_viscosity);
        f8 fx = f8_splat(0), fy = fx, fz = fx, ex = fx, ey = fx, ez = fx, full = fx, dense = fx;

        NEIGHBOURS (near, j) {
            Separation d = separation(args, at, near, j);
            if (__builtin_expect(near.coincident, 0))
                d = separate(args, i, j, d);

            const f8 q = f8_sqrt(d.r2) * inverse_h, f = shape(q, kernel);
            f8 push = pi + d.term;
            if (shifts) {
                ex += f * d.x, ey += f * d.y, ez += f * d.z;
                full += f * d.r2;
                dense += height(q, kernel);
            }
            if (viscous || artificial) {
                const f8x4 v = motion(args, j);
                const f8 ux = v.x - ui, uy = v.y - vi, uz = v.z - wi, both = volume * v.w;
                if (viscous && radial)
                    push += both * (mi + of_each(args->viscosity, mi, j)) * scale *
                            (ux * d.x + uy * d.y + uz * d.z);
                else if (viscous) {
                    const f8 drag = f * both * (mi + of_each(args->viscosity, mi, j));
                    fx += drag * ux;
                    fy += drag * uy;
                    fz += drag * uz;
                }
                if (artificial)
                    push += both * (ai + of_each(args->own[ARTIFICIAL], ai, j)) *
                            (ux * d.x + uy * d.y + uz * d.z) / (d.r2 + soft);
            }
            push *= f;
            fx += push * d.x;
            fy += push * d.y;
            fz += push * d.z;
        }
        args->fx[i] = w->gradient_scale * f8_sum(fx);
        args->fy[i] = w->gradient_scale * f8_sum(fy);
        args->fz[i] = w->gradient_scale * f8_sum(fz);
        if (shifts) {
            args->own[UNEVEN][i] = w->gradient_scale * f8_sum(ex);
            args->own[UNEVEN + 1][i] = w->gradient_scale * f8_sum(ey);
            args->own[UNEVEN + 2][i] = w->gradient_scale * f8_sum(ez);
            args->own[FULL][i] = w->gradient_scale * f8_sum(full);
            args->own[DENSE][i] = s->kernel_scale * (1 + f8_sum(dense));
        }
    }
}

SIMD_INLINE void rate_of(const PairArgs *args, size_t begin, size_t end, const ShapeKernel kernel)
{
    if (args->own[RELATIVE])
        rate_range(args, begin, end, kernel, true);
    else
        rate_range(args, begin, end, kernel, false);
}

SIMD_INLINE void viscous_with(const PairArgs *args, size_t begin, size_t end, const ShapeKernel kernel,
                              const bool artificial, const bool shifts)
{
    const bool viscous = args->constants->viscous;
    if (viscous && wcsph_constants(args->constants)->radial_friction > 0)
        wcsph_range(args, begin, end, kernel, true, true, artificial, shifts);
    else if (viscous)
        wcsph_range(args, begin, end, kernel, true, false, artificial, shifts);
    else
        wcsph_range(args, begin, end, kernel, false, false, artificial, shifts);
}

SIMD_INLINE void force_with(const PairArgs *args, size_t begin, size_t end, const ShapeKernel kernel,
                            const bool shifts)
{
    if (wcsph_is_artificial(args->constants))
        viscous_with(args, begin, end, kernel, true, shifts);
    else
        viscous_with(args, begin, end, kernel, false, shifts);
}

SIMD_INLINE void force_of(const PairArgs *args, size_t begin, size_t end, const ShapeKernel kernel)
{
    if (args->own[FULL])
        force_with(args, begin, end, kernel, true);
    else
        force_with(args, begin, end, kernel, false);
}

PAIR_LOOP(wcsph_slope)
{
    FOR_KERNEL(args, begin, end, slope_range);
}

PAIR_LOOP(wcsph_rate)
{
    FOR_KERNEL(args, begin, end, rate_of);
}

PAIR_LOOP(wcsph_force)
{
    FOR_KERNEL(args, begin, end, force_of);
}
