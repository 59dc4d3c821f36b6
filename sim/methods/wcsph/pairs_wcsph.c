/* Velocity change by a shift: (shift . grad) v, sim/methods/wcsph/wcsph_passes.c. With y = M^-1 shift, M =
   sum F x_ij x_ij^T over fluid neighbours, the change is sum F (v_i - v_j) (x_ij . y). Exact for linear
   velocity, also at walls and surfaces, since images take no part. */
#include "sim/methods/wcsph/pair_wcsph.h"

/* Sums of F x x^T, and of F x times velocity differences. */
typedef struct Slopes {
    Symmetric m;
    LaneVector u, v, w;
} Slopes;

SIMD_INLINE LaneVector plus(const LaneVector a, f8 x, f8 y, f8 z, f8 times)
{
    return (LaneVector){a.x + times * x, a.y + times * y, a.z + times * z};
}

SIMD_INLINE f8 dot(const LaneVector a, const LaneVector b)
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
    const LaneVector at = place_of(args, i);
    const NeighbourRange near = neighbour_range_of(args, i);
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
        const LaneVector shift = {f8_load(args->own[UNEVEN] + i), f8_load(args->own[UNEVEN + 1] + i),
                                  f8_load(args->own[UNEVEN + 2] + i)};
        const Slopes sum = slopes_of(args, i, kernel);
        const LaneVector y = renormalise(sum.m, shift);
        lanes_store(args->own[CARRIED], i, begin, end, dot(y, sum.u));
        lanes_store(args->own[CARRIED + 1], i, begin, end, dot(y, sum.v));
        lanes_store(args->own[CARRIED + 2], i, begin, end, dot(y, sum.w));
    }
}

PAIR_LOOP(wcsph_carried)
{
    FOR_KERNEL(args, begin, end, carry_range);
}

/* Additional friction in the radial form for corrected gradients, where neighbours are missing. A
   particle's friction is scaled by 1 + tr C / d, which is 1 over the filled share of the surrounding space;
   a pair uses the mean of both scales. So a free surface also dissipates 2 mu D : D, and momentum is
   conserved. Images and solids have separate friction. */

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
        const LaneVector at = place_of(args, i);
        const NeighbourRange near = neighbour_range_of(args, i);
        const f8 u = f8_load(args->vx + i), v = f8_load(args->vy + i), z = f8_load(args->vz + i);
        const f8 volume = lesser(f8_load(args->volume + i), most),
                 mu = args->viscosity ? f8_load(args->viscosity + i) : f8_splat(s->viscosity[0]),
                 half = half_of(f8_load(c[0] + i), f8_load(c[1] + i), f8_load(c[2] + i), s->dimensions);
        LaneVector sum = {zero, zero, zero};
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

/* Pair sums of wcsph. With grad W_ij = -F x_ij, x_ij = x_i - x_j, F = gradient f(r / h) >= 0:
     d rho_i / dt = (rho0_i / n0) (-sum F v_ij . x_ij)
   is the rate of number density, to which an interface between fluids makes no difference (Monaghan 1992),
   and
     force_i = sum (p_i V_i^2 + p_j V_j^2) F x_ij + ...
   conserves the energy of that rate. */

/* g / c^2, with the apparent gravity: the gradient of relative density of fluid at rest in the box. After: G.
   Fourtakas et al., "Local uniform stencil (LUST) boundary condition for arbitrary 3-D boundaries in parallel
   smoothed particle hydrodynamics (SPH) models", 2019. */
static LaneVector slope_at_rest(const PairArgs *args, size_t i, size_t begin, size_t end)
{
    const f8 scale = f8_splat(wcsph_constants(args->constants)->inverse_sound2);
    float g[3][LANES];
    gravity_of(args, i, begin, end, g);
    return (LaneVector){scale * f8_load(g[0]), scale * f8_load(g[1]), scale * f8_load(g[2])};
}

/* Gradient of relative density within a fluid, exact for linear fields: (sum F x x^T)^-1 sum F (e_i - e_j)
   x with x = x_ij (Antuono 2010, with equal volumes). Next to solids, where diffusion must level the gaps in
   the fluid's arrangement, that of fluid at rest: without any, diffusion would drive eddies around solids.
   "Next" is slightly less than h, so that lists from half a drift ago suffice. */
SIMD_INLINE void slope_range(const PairArgs *args, size_t begin, size_t end, const ShapeKernel kernel)
{
    const Constants *s = args->constants;
    const WcsphBlock *w = wcsph_constants(s);
    const float h = s->support_radius, least = 1e-6f * h;
    const f8 inverse_h = f8_splat(1 / h), h2 = f8_splat(h * h), least2 = f8_splat(least * least);
    const f8 next2 = f8_splat(NEXT_TO_SOLID * NEXT_TO_SOLID * h * h);
    const f8 scale = f8_splat(w->gradient_scale / s->rest_number_density); /* makes m = 1 on the lattice */
    const f8 first_solid = f8_splat(FLUIDS_MAX);

    GROUPS (i, begin, end) {
        const LaneVector at = place_of(args, i);
        const NeighbourRange near = neighbour_range_of(args, i);
        const f8 ri = f8_load(args->own[RELATIVE] + i), fi = f8_load(args->kind + i);
        i8 solid = i8_splat(0); /* a boundary particle is in reach */
        const f8 zero = f8_splat(0);
        Symmetric m = {zero, zero, zero, zero, zero, zero};
        LaneVector g = {zero, zero, zero};

        NEIGHBOURS (near, j) {
            Separation d = separation(args, at, j);
            const i8 seen = d.r2 < h2;
            const f8 kind = f8_gather(args->kind, j);
            solid |= (d.r2 < next2) & (kind >= first_solid);
            const i8 same = seen & (d.r2 >= least2) & (kind == fi);
            const f8 f = scale * f8_masked(same, shape(f8_sqrt(d.r2) * inverse_h, kernel));
            const f8 fx = f * d.x, fy = f * d.y, fz = f * d.z, de = ri - f8_gather(args->own[RELATIVE], j);
            m.xx += fx * d.x, m.yy += fy * d.y, m.zz += fz * d.z;
            m.xy += fx * d.y, m.yz += fy * d.z, m.zx += fz * d.x;
            g.x += fx * de, g.y += fy * de, g.z += fz * de;
        }
        if (s->dimensions == 2)
            m.zz = f8_splat(0.5f) * (m.xx + m.yy);
        g = renormalise(m, g);
        if (i8_bits(solid) != 0) {
            const LaneVector rest = slope_at_rest(args, i, begin, end);
            g.x = f8_select(solid, rest.x, g.x);
            g.y = f8_select(solid, rest.y, g.y);
            g.z = f8_select(solid, rest.z, g.z);
        }
        lanes_store(args->own[SLOPE], i, begin, end, g.x);
        lanes_store(args->own[SLOPE + 1], i, begin, end, g.y);
        lanes_store(args->own[SLOPE + 2], i, begin, end, g.z);
    }
}

/* Sum of F v_ij . x_ij, the flow's convergence, minus the diffusion of relative density within a fluid:
   density differences beyond the gradient (Molteni and Colagrossi 2009; Antuono 2010). With `solids` also
   the part of boundary particles, by the weights w of motion. */
SIMD_INLINE void rate_range(const PairArgs *args, size_t begin, size_t end, const ShapeKernel kernel,
                            const bool diffusive, const bool solids)
{
    const Constants *s = args->constants;
    const WcsphBlock *w = wcsph_constants(s);
    const float h = s->support_radius, least = 1e-6f * h;
    const f8 inverse_h = f8_splat(1 / h), least2 = f8_splat(least * least);
    const f8 diffusion = f8_splat(w->diffusion), half = f8_splat(0.5f);

    GROUPS (i, begin, end) {
        const LaneVector at = place_of(args, i);
        const NeighbourRange near = neighbour_range_of(args, i);
        const f8 ui = f8_load(args->vx + i), vi = f8_load(args->vy + i), wi = f8_load(args->vz + i);
        const f8 none = f8_splat(0), ri = diffusive ? f8_load(args->own[RELATIVE] + i) : none,
                 fi = diffusive ? f8_load(args->kind + i) : none;
        const f8 gx = diffusive ? f8_load(args->own[SLOPE] + i) : none,
                 gy = diffusive ? f8_load(args->own[SLOPE + 1] + i) : none,
                 gz = diffusive ? f8_load(args->own[SLOPE + 2] + i) : none;
        f8 sum = f8_splat(0), beside = sum;

        NEIGHBOURS (near, j) {
            Separation d = separation(args, at, j);
            const f8 f = f8_masked(d.r2 >= least2, shape(f8_sqrt(d.r2) * inverse_h, kernel));
            const f8x4 v = motion(args, j);
            f8 flow = (ui - v.x) * d.x + (vi - v.y) * d.y + (wi - v.z) * d.z;
            if (solids)
                beside += f * v.w * flow;
            if (diffusive) {
                const i8 same = f8_gather(args->kind, j) == fi;
                const f8 along = (gx + f8_gather(args->own[SLOPE], j)) * d.x +
                                 (gy + f8_gather(args->own[SLOPE + 1], j)) * d.y +
                                 (gz + f8_gather(args->own[SLOPE + 2], j)) * d.z;
                flow -= f8_masked(same, diffusion * (f8_gather(args->own[RELATIVE], j) - ri + half * along));
            }
            sum += f * flow;
        }
        lanes_store(args->fx, i, begin, end, f8_splat(-w->gradient_scale) * sum);
        if (solids)
            lanes_store(args->fy, i, begin, end, f8_splat(-w->gradient_scale) * beside);
    }
}

/* a_i + a_j of a pair. 0 between fluids of different density with artificial viscosity on both sides: these
   fluids slide, since numerical damping would brake waves between them. Solids and viscous fluids have a =
   0. */
SIMD_INLINE f8 artificial_of(const float *column, f8 ai, const uint32_t *j)
{
    if (!column)
        return ai + ai;
    const f8 aj = f8_gather(column, j);
    return f8_masked((aj == ai) | (ai * aj == f8_splat(0)), ai + aj);
}

/* Pressure, and laminar viscosity (sim/def/fluids.h) or artificial viscosity (Monaghan 1992, also for
   separating pairs): V_i V_j (mu_i + mu_j) F v_ji or V_i V_j (mu_i + mu_j) R F (v_ji . x_ij) x_ij, and -V_i
   V_j (a_i + a_j) (v_ij . x_ij) / (r^2 + h^2 / 400) F x_ij, with V at most the value at THINNEST. With
   `shifts` also the sums for sim/methods/wcsph/wcsph_passes.c. */
SIMD_INLINE void wcsph_group(const PairArgs *args, size_t i, size_t begin, size_t end,
                             const ShapeKernel kernel, const bool viscous, const bool radial,
                             const bool artificial, const bool shifts, const bool coincident)
{
    const Constants *s = args->constants;
    const WcsphBlock *w = wcsph_constants(s);
    const float h = s->support_radius;
    const f8 inverse_h = f8_splat(1 / h);
    const f8 gradient = f8_splat(w->gradient_scale), soft = f8_splat(h * h / 400),
             scale = f8_splat(w->radial_friction);
    const f8 most = f8_splat(1 / (THINNEST * s->rest_number_density));

    const LaneVector at = place_of(args, i);
    const NeighbourRange near = neighbour_range_of(args, i);
    const f8 ui = f8_load(args->vx + i), vi = f8_load(args->vy + i), wi = f8_load(args->vz + i);
    const f8 pi = f8_load(args->pressure_term + i), volume = lesser(f8_load(args->volume + i), most);
    const f8 mi = args->viscosity ? f8_load(args->viscosity + i) : f8_splat(s->viscosity[0]),
             ai = args->own[ARTIFICIAL] ? f8_load(args->own[ARTIFICIAL] + i)
                                        : f8_splat(w->wcsph_fluids[0].artificial_viscosity);
    f8 fx = f8_splat(0), fy = fx, fz = fx, ex = fx, ey = fx, ez = fx, full = fx, dense = fx;

    NEIGHBOURS (near, j) {
        Separation d = separation(args, at, j);
        if (coincident)
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
            const f8 ux = v.x - ui, uy = v.y - vi, uz = v.z - wi, both = volume * lesser(v.w, most);
            if (viscous && radial)
                push += both * pair_viscosities(args, mi, j) * scale * (ux * d.x + uy * d.y + uz * d.z);
            else if (viscous) {
                const f8 drag = f * both * pair_viscosities(args, mi, j);
                fx += drag * ux;
                fy += drag * uy;
                fz += drag * uz;
            }
            if (artificial)
                push += both * artificial_of(args->own[ARTIFICIAL], ai, j) *
                        (ux * d.x + uy * d.y + uz * d.z) / (d.r2 + soft);
        }
        push *= f;
        fx += push * d.x;
        fy += push * d.y;
        fz += push * d.z;
    }
    lanes_store(args->fx, i, begin, end, gradient * fx);
    lanes_store(args->fy, i, begin, end, gradient * fy);
    lanes_store(args->fz, i, begin, end, gradient * fz);
    if (shifts) {
        lanes_store(args->own[UNEVEN], i, begin, end, gradient * ex);
        lanes_store(args->own[UNEVEN + 1], i, begin, end, gradient * ey);
        lanes_store(args->own[UNEVEN + 2], i, begin, end, gradient * ez);
        lanes_store(args->own[FULL], i, begin, end, gradient * full);
        lanes_store(args->own[DENSE], i, begin, end, f8_splat(s->kernel_scale) * (f8_splat(1) + dense));
    }
}

/* For a group with coincident particles: a loop apart, since the test would cost the usual loop registers. */
static __attribute__((noinline)) void coincident_group(const PairArgs *args, size_t i, size_t begin,
                                                       size_t end, ShapeKernel kernel, bool viscous,
                                                       bool radial, bool artificial, bool shifts)
{
    wcsph_group(args, i, begin, end, kernel, viscous, radial, artificial, shifts, true);
}

SIMD_INLINE void wcsph_range(const PairArgs *args, size_t begin, size_t end, const ShapeKernel kernel,
                             const bool viscous, const bool radial, const bool artificial, const bool shifts)
{
    GROUPS (i, begin, end)
        if (__builtin_expect(neighbour_range_of(args, i).coincident, 0))
            coincident_group(args, i, begin, end, kernel, viscous, radial, artificial, shifts);
        else
            wcsph_group(args, i, begin, end, kernel, viscous, radial, artificial, shifts, false);
}

SIMD_INLINE void rate_with(const PairArgs *args, size_t begin, size_t end, const ShapeKernel kernel,
                           const bool solids)
{
    if (args->own[RELATIVE])
        rate_range(args, begin, end, kernel, true, solids);
    else
        rate_range(args, begin, end, kernel, false, solids);
}

SIMD_INLINE void rate_of(const PairArgs *args, size_t begin, size_t end, const ShapeKernel kernel)
{
    if (args->own[BOUNDARY_PART])
        rate_with(args, begin, end, kernel, true);
    else
        rate_with(args, begin, end, kernel, false);
}

SIMD_INLINE void viscous_with(const PairArgs *args, size_t begin, size_t end, const ShapeKernel kernel,
                              const bool artificial, const bool shifts)
{
    const bool viscous = args->constants->rubs;
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
