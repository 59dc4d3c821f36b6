/* The pair sums of mueller. */
#include "sim/cpu/pair_loop.h"
#include "sim/mueller/passes.h"

/* sum W; Müller 2003, eq. 3 with unit mass (Solenthaler 2008). poly6 = (1 - q^2)^3, spiky = (1 - q)^3; the
   scale comes last. */
SIMD_INLINE void density_range(const PairArgs *args, size_t begin, size_t end, const bool poly6)
{
    const float h = args->constants->support_radius;
    const f8 inverse_h = f8_splat(1 / h), one = f8_splat(1), zero = f8_splat(0);
    Rows rows = ROWS_NONE;

    for (size_t i = begin; i < end; i++) {
        const Place at = place_of(args, i);
        f8 sum = zero;
        rows_of(args, args->cell[i], &rows);
        NEIGHBOURS (rows, row, j) {
            Separation d = separation(args, at, &rows, row, j);
            const f8 q2 = d.r2 * inverse_h * inverse_h;
            const f8 t = one - (poly6 ? q2 : f8_sqrt(q2));
            const i8 near = (t > zero) & d.there;
            sum += f8_masked(near, t * t * t);
        }
        args->number_density[i] = args->constants->kernel_scale * f8_sum(sum);
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
    const float h = s->support_radius, least = 1e-6f * h;
    const f8 inverse_h = f8_splat(1 / h), h2 = f8_splat(h * h), least2 = f8_splat(least * least);
    const f8 one = f8_splat(1), pressure_scale = f8_splat(s->pressure_scale);
    const float viscosity_scale = s->viscosity_scale * (many ? 0.5f : s->viscosity[0]);
    Rows rows = ROWS_NONE;

    for (size_t i = begin; i < end; i++) {
        const Place at = place_of(args, i);
        const f8 ui = f8_splat(args->vx[i]), vi = f8_splat(args->vy[i]), wi = f8_splat(args->vz[i]);
        const f8 pi = f8_splat(args->pressure_term[i]);
        const f8 mi = f8_splat(viscous && many ? args->viscosity[i] : 0);
        const f8 drag_scale = f8_splat(viscosity_scale * args->volume[i]);
        f8 fx = f8_splat(0), fy = fx, fz = fx;

        rows_of(args, args->cell[i], &rows);
        NEIGHBOURS (rows, row, j) {
            Separation d = separation(args, at, &rows, row, j);
            const i8 near = (d.r2 < h2) & d.there & others(i, j);
            if (!i8_bits(near))
                continue;
            const int coincident = i8_bits(near & (d.r2 < least2));
            if (__builtin_expect(coincident, 0))
                d = separate(args, i, j, coincident, least, d);

            const f8 r = f8_sqrt(f8_select(near, d.r2, h2));
            const f8 t = one - r * inverse_h;
            const f8 push =
                f8_masked(near, pressure_scale * (t * t) * (pi + f8_load(args->pressure_term + j)) / r);
            fx += push * d.x;
            fy += push * d.y;
            fz += push * d.z;
            if (viscous) {
                f8 drag = f8_masked(near, drag_scale * t * f8_load(args->volume + j));
                if (many)
                    drag *= mi + f8_load(args->viscosity + j);
                fx += drag * (f8_load(args->vx + j) - ui);
                fy += drag * (f8_load(args->vy + j) - vi);
                fz += drag * (f8_load(args->vz + j) - wi);
            }
        }
        args->fx[i] = f8_sum(fx);
        args->fy[i] = f8_sum(fy);
        args->fz[i] = f8_sum(fz);
    }
}

PAIR_LOOP(mueller_force)
{
    if (!args->constants->viscous)
        force_range(args, begin, end, false, false);
    else if (!args->viscosity)
        force_range(args, begin, end, true, false);
    else
        force_range(args, begin, end, true, true);
}
