/* The pair sums of mueller. */
#include "sim/cpu/pair_loop.h"
#include "sim/mueller/passes.h"

/* sum W; Müller 2003, eq. 3 with unit mass (Solenthaler 2008). poly6 = (1 - q^2)^3, spiky = (1 - q)^3; the
   scale comes last. */
SIMD_INLINE void density_range(const PairArgs *args, size_t begin, size_t end, const bool poly6)
{
    const float h = args->constants->support_radius;
    const f8 inverse_h = f8_splat(1 / h), one = f8_splat(1), scale = f8_splat(args->constants->kernel_scale);

    GROUPS (i, begin, end) {
        const Place at = place_of(args, i);
        const Near near = near_of(args, i);
        f8 sum = f8_splat(0);
        NEIGHBOURS (near, j) {
            const Separation d = separation(args, at, j);
            const f8 t = poly6 ? f8_positive(one - d.r2 * inverse_h * inverse_h)
                               : closeness(f8_sqrt(d.r2) * inverse_h);
            sum += t * t * t;
        }
        lanes_store(args->number_density, i, begin, end, scale * (one + sum)); /* 1: its own */
    }
}

PAIR_LOOP(mueller_density)
{
    if (mueller_constants(args->constants)->poly6)
        density_range(args, begin, end, true);
    else
        density_range(args, begin, end, false);
}

/* Forces of pressure and viscosity, eq. 10 and 14. With volumes V = 1 / n in place of m / rho and the
   pressure terms p_i V_i^2 + p_j V_j^2 (the gradient of sum e(n_i), so that energy is conserved) they are
   symmetric for every density ratio. Eq. 10 has (p_i + p_j) / 2 in that place, which makes half of grad p:
   p_j alone sums up to grad p, p_i is there for symmetry only. */
SIMD_INLINE void force_range(const PairArgs *args, size_t begin, size_t end, const bool viscous,
                             const bool many)
{
    const Constants *s = args->constants;
    const f8 inverse_h = f8_splat(1 / s->support_radius), pressure_scale = f8_splat(s->pressure_scale);
    const f8 viscosity_scale = f8_splat(s->viscosity_scale * (many ? 0.5f : s->viscosity[0]));

    GROUPS (i, begin, end) {
        const Place at = place_of(args, i);
        const Near near = near_of(args, i);
        const f8 ui = f8_load(args->vx + i), vi = f8_load(args->vy + i), wi = f8_load(args->vz + i);
        const f8 pi = f8_load(args->pressure_term + i);
        const f8 mi = viscous && many ? f8_load(args->viscosity + i) : f8_splat(0);
        const f8 drag_scale = viscosity_scale * f8_load(args->volume + i);
        f8 fx = f8_splat(0), fy = fx, fz = fx;

        NEIGHBOURS (near, j) {
            Separation d = separation(args, at, j);
            if (__builtin_expect(near.coincident, 0))
                d = separate(args, i, j, d);

            const f8 r = f8_sqrt(d.r2), t = closeness(r * inverse_h);
            const f8 push = pressure_scale * (t * t) * (pi + d.term) / r;
            fx += push * d.x;
            fy += push * d.y;
            fz += push * d.z;
            if (viscous) {
                const f8x4 v = motion(args, j);
                f8 drag = drag_scale * t * v.w;
                if (many)
                    drag *= mi + f8_gather(args->viscosity, j);
                fx += drag * (v.x - ui);
                fy += drag * (v.y - vi);
                fz += drag * (v.z - wi);
            }
        }
        lanes_store(args->fx, i, begin, end, fx);
        lanes_store(args->fy, i, begin, end, fy);
        lanes_store(args->fz, i, begin, end, fz);
    }
}

PAIR_LOOP(mueller_force)
{
    if (!args->constants->rubs)
        force_range(args, begin, end, false, false);
    else if (!args->viscosity)
        force_range(args, begin, end, true, false);
    else
        force_range(args, begin, end, true, true);
}
