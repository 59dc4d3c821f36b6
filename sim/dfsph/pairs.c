/* The pair sums of dfsph: see sim/dfsph/passes.h. */
#include "sim/cpu/pair_images.h"
#include "sim/cpu/pair_loop.h"
#include "sim/cpu/pair_shape.h"
#include "sim/dfsph/passes.h"

/* Sum of W into `volume`, of F x_ij into the force, and of F^2 r^2 / m_j. */
PAIR_LOOP(dfsph_factor)
{
    const Constants *s = args->constants;
    const f8 inverse_h = f8_splat(1 / s->support_radius), gradient = f8_splat(dfsph_constants(s)->gradient);
    GROUPS (i, begin, end) {
        const Place at = place_of(args, i);
        const Near near = near_of(args, i);
        f8 n = f8_splat(1), sx = f8_splat(0), sy = sx, sz = sx, squares = sx;
        NEIGHBOURS (near, j) {
            Separation d = separation(args, at, j);
            if (__builtin_expect(near.coincident, 0))
                d = separate(args, i, j, d);
            const f8 q = f8_sqrt(d.r2) * inverse_h, f = gradient * shape(q, DFSPH_KERNEL);
            n += height(q, DFSPH_KERNEL);
            sx += f * d.x, sy += f * d.y, sz += f * d.z;
            squares += f * f * d.r2 * f8_gather(args->own[INVERSE_MASS], j);
        }
        lanes_store(args->number_density, i, begin, end, f8_splat(s->kernel_scale) * n);
        lanes_store(args->fx, i, begin, end, sx);
        lanes_store(args->fy, i, begin, end, sy);
        lanes_store(args->fz, i, begin, end, sz);
        lanes_store(args->own[SQUARES], i, begin, end, squares);
    }
}

/* sum (k_i + k_j) F x_ij. */
PAIR_LOOP(dfsph_push)
{
    const Constants *s = args->constants;
    const f8 inverse_h = f8_splat(1 / s->support_radius), gradient = f8_splat(dfsph_constants(s)->gradient);
    GROUPS (i, begin, end) {
        const Place at = place_of(args, i);
        const Near near = near_of(args, i);
        const f8 ki = f8_load(args->pressure_term + i);
        f8 fx = f8_splat(0), fy = fx, fz = fx;
        NEIGHBOURS (near, j) {
            Separation d = separation(args, at, j);
            if (__builtin_expect(near.coincident, 0))
                d = separate(args, i, j, d);
            const f8 push = (ki + d.term) * shape(f8_sqrt(d.r2) * inverse_h, DFSPH_KERNEL);
            fx += push * d.x, fy += push * d.y, fz += push * d.z;
        }
        lanes_store(args->fx, i, begin, end, gradient * fx);
        lanes_store(args->fy, i, begin, end, gradient * fy);
        lanes_store(args->fz, i, begin, end, gradient * fz);
    }
}

/* -sum F v_ij . x_ij, with the velocities that `motion` has. */
PAIR_LOOP(dfsph_rate)
{
    const Constants *s = args->constants;
    const f8 inverse_h = f8_splat(1 / s->support_radius), gradient = f8_splat(dfsph_constants(s)->gradient);
    GROUPS (i, begin, end) {
        const Place at = place_of(args, i);
        const Near near = near_of(args, i);
        const Themselves own = themselves(args, i);
        const f8x4 vi = motion(args, own.j);
        f8 sum = f8_splat(0);
        NEIGHBOURS (near, j) {
            Separation d = separation(args, at, j);
            if (__builtin_expect(near.coincident, 0))
                d = separate(args, i, j, d);
            const f8x4 v = motion(args, j);
            sum += shape(f8_sqrt(d.r2) * inverse_h, DFSPH_KERNEL) *
                   ((vi.x - v.x) * d.x + (vi.y - v.y) * d.y + (vi.z - v.z) * d.z);
        }
        lanes_store(args->own[RESIDUAL], i, begin, end, -(gradient * sum));
    }
}

/* Friction in the form of Morris (sim/matter/viscosity.h): V_i V_j (mu_i + mu_j) F v_ji. */
PAIR_LOOP(dfsph_friction)
{
    const Constants *s = args->constants;
    const f8 inverse_h = f8_splat(1 / s->support_radius),
             gradient = f8_splat(dfsph_constants(s)->friction_gradient), same = f8_splat(s->viscosity[0]);
    GROUPS (i, begin, end) {
        const Place at = place_of(args, i);
        const Near near = near_of(args, i);
        const f8 ui = f8_load(args->vx + i), vi = f8_load(args->vy + i), wi = f8_load(args->vz + i);
        const f8 mi = args->viscosity ? f8_load(args->viscosity + i) : same;
        const f8 scale = gradient * f8_load(args->volume + i), least = f8_splat(1e-6f);
        f8 fx = f8_splat(0), fy = fx, fz = fx;
        NEIGHBOURS (near, j) {
            const Separation d = separation(args, at, j);
            const f8 q = f8_sqrt(d.r2) * inverse_h, apart = f8_select(q > least, q, least);
            const f8x4 v = motion(args, j);
            const f8 mj = args->viscosity ? f8_gather(args->viscosity, j) : same;
            const f8 drag = scale * v.w * (mi + mj) * shape(apart, DFSPH_KERNEL);
            fx += drag * (v.x - ui), fy += drag * (v.y - vi), fz += drag * (v.z - wi);
        }
        lanes_store(args->fx, i, begin, end, fx);
        lanes_store(args->fy, i, begin, end, fy);
        lanes_store(args->fz, i, begin, end, fz);
    }
}
