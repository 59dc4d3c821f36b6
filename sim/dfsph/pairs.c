/* The pair sums of dfsph: see sim/dfsph/passes.h. */
#include "sim/cpu/pair_images.h"
#include "sim/cpu/pair_loop.h"
#include "sim/cpu/pair_shape.h"
#include "sim/dfsph/image.h"
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
                d = separate_to(args, i, j, d, TWINS_PART);
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

/* The images of a group, each of its particle; none where no wall is near. */
typedef struct Mirrors {
    int count;
    Mirrored of[IMAGES_MAX];
} Mirrors;

SIMD_INLINE void mirrors_of(const PairArgs *args, const WallsFar *far, size_t i, size_t begin, size_t end,
                            Mirrors *mirrors)
{
    Images images;
    mirrors->count = images_of(args, far, i, begin, end, &images) ? images.most - 1 : 0;
    for (int m = 0; m < mirrors->count; m++)
        mirrors->of[m] = mirrored(&images, m + 1);
}

/* sum (k_i + k_j) F x_ij, that of an image in its mirror's axes. */
SIMD_INLINE void push_by(const PairArgs *args, const Mirrored *image, f8 ki, f8x4 near, Place *sum)
{
    const Separation d = apart(args, image->at, near);
    const f8 push = (ki + d.term) * shape(image_q(args->constants, d.r2), DFSPH_KERNEL);
    sum->x += image->sign.x * push * d.x;
    sum->y += image->sign.y * push * d.y;
    sum->z += image->sign.z * push * d.z;
}

SIMD_INLINE void push_of(const PairArgs *args, size_t i, const Near near, f8 ki, const Mirrors *mirrors,
                         Place *sum)
{
    const f8 inverse_h = f8_splat(1 / args->constants->support_radius);
    const Place at = place_of(args, i);
    NEIGHBOURS (near, j) {
        const f8x4 p = f8_load4(args->place, j);
        Separation d = apart(args, at, p);
        if (__builtin_expect(near.coincident, 0))
            d = separate_to(args, i, j, d, TWINS_PART);
        const f8 push = (ki + d.term) * shape(f8_sqrt(d.r2) * inverse_h, DFSPH_KERNEL);
        sum->x += push * d.x, sum->y += push * d.y, sum->z += push * d.z;
        for (int m = 0; mirrors && m < mirrors->count; m++)
            push_by(args, &mirrors->of[m], ki, p, sum);
    }
}

/* Of images the particles' own among them. */
PAIR_LOOP(dfsph_push)
{
    const f8 gradient = f8_splat(dfsph_constants(args->constants)->gradient);
    const WallsFar far = out_of_sight(args->constants);
    Mirrors mirrors;
    GROUPS (i, begin, end) {
        const f8 ki = f8_load(args->pressure_term + i);
        const Themselves own = themselves(args, i);
        Place sum = {f8_splat(0), f8_splat(0), f8_splat(0)};
        mirrors_of(args, &far, i, begin, end, &mirrors);
        if (mirrors.count == 0)
            push_of(args, i, near_of(args, i), ki, NULL, &sum);
        else
            push_of(args, i, near_of(args, i), ki, &mirrors, &sum);
        for (int m = 0; m < mirrors.count; m++)
            push_by(args, &mirrors.of[m], ki, f8_load4(args->place, own.j), &sum);
        lanes_store(args->fx, i, begin, end, gradient * sum.x);
        lanes_store(args->fy, i, begin, end, gradient * sum.y);
        lanes_store(args->fz, i, begin, end, gradient * sum.z);
    }
}

/* sum F v_ij . x_ij of an image. */
SIMD_INLINE f8 rate_by(const PairArgs *args, const Mirrored *image, f8x4 vi, f8x4 near, f8x4 v)
{
    const Separation d = apart(args, image->at, near);
    return shape(image_q(args->constants, d.r2), DFSPH_KERNEL) *
           ((image->sign.x * vi.x - v.x) * d.x + (image->sign.y * vi.y - v.y) * d.y +
            (image->sign.z * vi.z - v.z) * d.z);
}

SIMD_INLINE f8 rate_of(const PairArgs *args, size_t i, const Near near, f8x4 vi, const Mirrors *mirrors)
{
    const f8 inverse_h = f8_splat(1 / args->constants->support_radius);
    const Place at = place_of(args, i);
    f8 sum = f8_splat(0);
    NEIGHBOURS (near, j) {
        const f8x4 p = f8_load4(args->place, j), v = motion(args, j);
        Separation d = apart(args, at, p);
        if (__builtin_expect(near.coincident, 0))
            d = separate_to(args, i, j, d, TWINS_PART);
        sum += shape(f8_sqrt(d.r2) * inverse_h, DFSPH_KERNEL) *
               ((vi.x - v.x) * d.x + (vi.y - v.y) * d.y + (vi.z - v.z) * d.z);
        for (int m = 0; mirrors && m < mirrors->count; m++)
            sum += rate_by(args, &mirrors->of[m], vi, p, v);
    }
    return sum;
}

/* -sum F v_ij . x_ij, with the velocities that `motion` has; of images the particles' own among them. */
PAIR_LOOP(dfsph_rate)
{
    const f8 gradient = f8_splat(dfsph_constants(args->constants)->gradient);
    const WallsFar far = out_of_sight(args->constants);
    Mirrors mirrors;
    GROUPS (i, begin, end) {
        const Themselves own = themselves(args, i);
        const f8x4 vi = motion(args, own.j);
        mirrors_of(args, &far, i, begin, end, &mirrors);
        f8 sum = mirrors.count == 0 ? rate_of(args, i, near_of(args, i), vi, NULL)
                                    : rate_of(args, i, near_of(args, i), vi, &mirrors);
        for (int m = 0; m < mirrors.count; m++)
            sum += rate_by(args, &mirrors.of[m], vi, f8_load4(args->place, own.j), vi);
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
