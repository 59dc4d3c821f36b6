/* The pair sums of pbf: see sim/pbf/passes.h. */
#include "sim/cpu/pair_images.h"
#include "sim/cpu/pair_loop.h"
#include "sim/cpu/pair_shape.h"
#include "sim/pbf/passes.h"

/* Sum of W into `number_density`, of F x_ij into the force, and of F^2 r^2 / m_j, where `place` has 1 / m. */
PAIR_LOOP(pbf_sums)
{
    const Constants *s = args->constants;
    const f8 inverse_h = f8_splat(1 / s->support_radius), gradient = f8_splat(pbf_constants(s)->gradient);
    GROUPS (i, begin, end) {
        const Place at = place_of(args, i);
        const Near near = near_of(args, i);
        f8 n = f8_splat(1), sx = f8_splat(0), sy = sx, sz = sx, squares = sx;
        NEIGHBOURS (near, j) {
            Separation d = separation(args, at, j);
            if (__builtin_expect(near.coincident, 0))
                d = separate_to(args, i, j, d, TWINS_PART);
            const f8 q = f8_sqrt(d.r2) * inverse_h, f = shape(q, PBF_KERNEL);
            n += height(q, PBF_KERNEL);
            sx += f * d.x, sy += f * d.y, sz += f * d.z;
            squares += f * f * d.r2 * d.term;
        }
        lanes_store(args->number_density, i, begin, end, f8_splat(s->kernel_scale) * n);
        lanes_store(args->fx, i, begin, end, gradient * sx);
        lanes_store(args->fy, i, begin, end, gradient * sy);
        lanes_store(args->fz, i, begin, end, gradient * sz);
        lanes_store(args->own[SQUARES], i, begin, end, gradient * gradient * squares);
    }
}

/* sum (dk_i + dk_j) F x_ij, where `place` has dk. */
PAIR_LOOP(pbf_push)
{
    const Constants *s = args->constants;
    const f8 inverse_h = f8_splat(1 / s->support_radius), gradient = f8_splat(pbf_constants(s)->gradient);
    GROUPS (i, begin, end) {
        const Place at = place_of(args, i);
        const Near near = near_of(args, i);
        const Themselves own = themselves(args, i);
        const f8 ki = f8_load4(args->place, own.j).w;
        f8 fx = f8_splat(0), fy = fx, fz = fx;
        NEIGHBOURS (near, j) {
            Separation d = separation(args, at, j);
            if (__builtin_expect(near.coincident, 0))
                d = separate_to(args, i, j, d, TWINS_PART);
            const f8 push = (ki + d.term) * shape(f8_sqrt(d.r2) * inverse_h, PBF_KERNEL);
            fx += push * d.x, fy += push * d.y, fz += push * d.z;
        }
        lanes_store(args->fx, i, begin, end, gradient * fx);
        lanes_store(args->fy, i, begin, end, gradient * fy);
        lanes_store(args->fz, i, begin, end, gradient * fz);
    }
}

/* Friction in the form of Morris (sim/matter/viscosity.h): V_i V_j (mu_i + mu_j) F v_ji. */
PAIR_LOOP(pbf_friction)
{
    const Constants *s = args->constants;
    const f8 inverse_h = f8_splat(1 / s->support_radius),
             gradient = f8_splat(pbf_constants(s)->friction_gradient), same = f8_splat(s->viscosity[0]);
    GROUPS (i, begin, end) {
        const Place at = place_of(args, i);
        const Near near = near_of(args, i);
        const Themselves own = themselves(args, i);
        const f8x4 vi = motion(args, own.j);
        const f8 mi = args->viscosity ? f8_load(args->viscosity + i) : same;
        const f8 scale = gradient * vi.w, least = f8_splat(1e-6f);
        f8 fx = f8_splat(0), fy = fx, fz = fx;
        NEIGHBOURS (near, j) {
            const Separation d = separation(args, at, j);
            const f8 q = f8_sqrt(d.r2) * inverse_h, apart = f8_select(q > least, q, least);
            const f8x4 v = motion(args, j);
            const f8 mj = args->viscosity ? f8_gather(args->viscosity, j) : same;
            const f8 drag = scale * v.w * (mi + mj) * shape(apart, PBF_KERNEL);
            fx += drag * (v.x - vi.x), fy += drag * (v.y - vi.y), fz += drag * (v.z - vi.z);
        }
        lanes_store(args->fx, i, begin, end, fx);
        lanes_store(args->fy, i, begin, end, fy);
        lanes_store(args->fz, i, begin, end, fz);
    }
}
