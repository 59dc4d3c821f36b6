/* Pair sums of methods with a fixed number density (Method.incompressible). Images of the fluid in the walls
   of the box have their particles' multipliers: a wall pushes with the gradient of the images' number
   density, and can do no work. For files compiled once per instruction set; a method's pair loops call these
   sums with the method's factors.

   With grad W_ij = -F x_ij, x_ij = x_i - x_j; F is `gradient` times shape(). */
#ifndef SIM_METHODS_SHARED_PAIR_INCOMPRESSIBLE_H
#define SIM_METHODS_SHARED_PAIR_INCOMPRESSIBLE_H

#include "sim/cpu/pair_loop.h"
#include "sim/methods/shared/incompressible.h"

/* r / h of an image, above 0 even next to the particle. */
SIMD_INLINE f8 image_q(const Constants *s, f8 r2)
{
    const float h = s->support_radius, least = 1e-6f * h;
    return f8_sqrt(greater(r2, f8_splat(least * least))) * f8_splat(1 / h);
}

/* --- effect of a particle's k on its own number density --- */

typedef struct DensitySums {
    f8 n, x, y, z, squares;
} DensitySums;

/* Part of an image. `times`: 2 for the image of the particle itself, with the same k; then the inverse mass
   is 0. */
SIMD_INLINE void density_by(const PairArgs *args, const ImageParticle *image, f8x4 near, float times,
                            f8 inverse_mass, DensitySums *sum)
{
    const Separation d = apart(image->at, near);
    const f8 q = image_q(args->constants, d.r2), f = f8_splat(times) * shape(q, INCOMPRESSIBLE_KERNEL);
    sum->n += height(q, INCOMPRESSIBLE_KERNEL);
    sum->x += image->sign.x * f * d.x;
    sum->y += image->sign.y * f * d.y;
    sum->z += image->sign.z * f * d.z;
    sum->squares += f * f * d.r2 * inverse_mass;
}

SIMD_INLINE void density_of(const PairArgs *args, size_t i, const NeighbourRange near,
                            const LaneImages *images, DensitySums *sum)
{
    const f8 inverse_h = f8_splat(1 / args->constants->support_radius);
    const LaneVector at = place_of(args, i);
    NEIGHBOURS (near, j) {
        const f8x4 p = f8_load4(args->place, j);
        Separation d = apart(at, p);
        if (__builtin_expect(near.coincident, 0))
            d = separate_to(args, i, j, d, TWINS_PART);
        const f8 q = f8_sqrt(d.r2) * inverse_h, f = shape(q, INCOMPRESSIBLE_KERNEL);
        sum->n += height(q, INCOMPRESSIBLE_KERNEL);
        sum->x += f * d.x, sum->y += f * d.y, sum->z += f * d.z;
        sum->squares += f * f * d.r2 * d.term;
        for (int m = 1; images && m <= images->count; m++)
            density_by(args, &images->of[m], p, 1, p.w, sum);
    }
}

/* |sum F x_ij|, where the image of the particle itself counts once: how the number density falls. */
SIMD_INLINE f8 slope_of(const PairArgs *args, const SelfLanes *own, const LaneImages *images,
                        const DensitySums *sum)
{
    const f8x4 at = f8_load4(args->place, own->j);
    DensitySums once = *sum;
    for (int m = 1; m <= images->count; m++)
        density_by(args, &images->of[m], at, -1, f8_splat(0), &once);
    return f8_sqrt(once.x * once.x + once.y * once.y + once.z * once.z);
}

/* Sum of W into `number_density`, of F x_ij into the force, of F^2 r^2 / m_j into `squares`, and slope_of
   into `slope`, unless NULL; `place` has 1 / m. */
SIMD_INLINE void density_sums(const PairArgs *args, size_t begin, size_t end, float gradient, float *squares,
                              float *slope)
{
    const f8 scale = f8_splat(args->constants->kernel_scale), g = f8_splat(gradient), zero = f8_splat(0);
    const WallsFar far = out_of_sight(args->constants);
    LaneImages images;
    GROUPS (i, begin, end) {
        const SelfLanes own = themselves(args, i);
        DensitySums sum = {f8_splat(1), zero, zero, zero, zero};
        const bool mirrored = images_of(args, &far, i, begin, end, &images);
        if (!mirrored)
            density_of(args, i, neighbour_range_of(args, i), NULL, &sum);
        else
            density_of(args, i, neighbour_range_of(args, i), &images, &sum);
        for (int m = 1; m <= images.count; m++)
            density_by(args, &images.of[m], f8_load4(args->place, own.j), 2, zero, &sum);
        lanes_store(args->number_density, i, begin, end, scale * sum.n);
        lanes_store(args->fx, i, begin, end, g * sum.x);
        lanes_store(args->fy, i, begin, end, g * sum.y);
        lanes_store(args->fz, i, begin, end, g * sum.z);
        lanes_store(squares, i, begin, end, g * g * sum.squares);
        if (slope)
            lanes_store(slope, i, begin, end, g * slope_of(args, &own, &images, &sum));
    }
}

/* --- push by k --- */

/* (k_i + k_j) F x_ij of an image, in the particle's axes. */
SIMD_INLINE void push_by(const PairArgs *args, const ImageParticle *image, f8 ki, f8x4 near, LaneVector *sum)
{
    const Separation d = apart(image->at, near);
    const f8 push = (ki + d.term) * shape(image_q(args->constants, d.r2), INCOMPRESSIBLE_KERNEL);
    sum->x += image->sign.x * push * d.x;
    sum->y += image->sign.y * push * d.y;
    sum->z += image->sign.z * push * d.z;
}

SIMD_INLINE void push_of(const PairArgs *args, size_t i, const NeighbourRange near, f8 ki,
                         const LaneImages *images, LaneVector *sum)
{
    const f8 inverse_h = f8_splat(1 / args->constants->support_radius);
    const LaneVector at = place_of(args, i);
    NEIGHBOURS (near, j) {
        const f8x4 p = f8_load4(args->place, j);
        Separation d = apart(at, p);
        if (__builtin_expect(near.coincident, 0))
            d = separate_to(args, i, j, d, TWINS_PART);
        const f8 push = (ki + d.term) * shape(f8_sqrt(d.r2) * inverse_h, INCOMPRESSIBLE_KERNEL);
        sum->x += push * d.x, sum->y += push * d.y, sum->z += push * d.z;
        for (int m = 1; images && m <= images->count; m++)
            push_by(args, &images->of[m], ki, p, sum);
    }
}

/* sum (k_i + k_j) F x_ij into the force; `place` has k. */
SIMD_INLINE void push_sums(const PairArgs *args, size_t begin, size_t end, float gradient)
{
    const f8 g = f8_splat(gradient), zero = f8_splat(0);
    const WallsFar far = out_of_sight(args->constants);
    LaneImages images;
    GROUPS (i, begin, end) {
        const SelfLanes own = themselves(args, i);
        const f8 ki = f8_load4(args->place, own.j).w;
        LaneVector sum = {zero, zero, zero};
        const bool mirrored = images_of(args, &far, i, begin, end, &images);
        if (!mirrored)
            push_of(args, i, neighbour_range_of(args, i), ki, NULL, &sum);
        else
            push_of(args, i, neighbour_range_of(args, i), ki, &images, &sum);
        for (int m = 1; m <= images.count; m++)
            push_by(args, &images.of[m], ki, f8_load4(args->place, own.j), &sum);
        lanes_store(args->fx, i, begin, end, g * sum.x);
        lanes_store(args->fy, i, begin, end, g * sum.y);
        lanes_store(args->fz, i, begin, end, g * sum.z);
    }
}

/* --- friction --- */

/* Friction of particles at `at` with velocities `vi`, without the factor of the gradient; distances below
   `nearest` (in h) count as `nearest`. */
SIMD_INLINE void friction_of(const PairArgs *args, const LaneVector at, const NeighbourRange near, f8x4 vi,
                             f8 mi, float nearest, LaneVector *sum)
{
    const Constants *s = args->constants;
    const f8 inverse_h = f8_splat(1 / s->support_radius), least = f8_splat(nearest);
    NEIGHBOURS (near, j) {
        const Separation d = separation(args, at, j);
        const f8 q = f8_sqrt(d.r2) * inverse_h, apart = f8_select(q > least, q, least);
        const f8x4 v = motion(args, j);
        const f8 drag = vi.w * v.w * pair_viscosities(args, mi, j) * shape(apart, INCOMPRESSIBLE_KERNEL);
        sum->x += drag * (v.x - vi.x), sum->y += drag * (v.y - vi.y), sum->z += drag * (v.z - vi.z);
    }
}

/* Morris's form (sim/def/fluids.h): V_i V_j (mu_i + mu_j) F v_ji, with velocities from `motion`. Where
   walls let fluid slip, images take part, with velocities in the mirror, at distances of at least half a
   spacing. At smaller distances a particle on a wall would turn round in a step stable elsewhere. */
SIMD_INLINE void friction_sums(const PairArgs *args, size_t begin, size_t end, float gradient)
{
    const Constants *s = args->constants;
    const f8 g = f8_splat(gradient), zero = f8_splat(0);
    const float half = 0.5f * s->spacing / s->support_radius;
    const WallsFar far = out_of_sight(s);
    LaneImages images;
    GROUPS (i, begin, end) {
        const SelfLanes own = themselves(args, i);
        const NeighbourRange near = neighbour_range_of(args, i);
        const f8x4 vi = motion(args, own.j);
        const f8 mi = args->viscosity ? f8_load(args->viscosity + i) : f8_splat(s->viscosity[0]);
        LaneVector sum = {zero, zero, zero};
        friction_of(args, place_of(args, i), near, vi, mi, 1e-6f, &sum);
        const bool mirrored = !s->no_slip && images_of(args, &far, i, begin, end, &images);
        for (int m = 1; mirrored && m <= images.count; m++) {
            const ImageParticle *image = &images.of[m];
            const f8x4 v = {image->sign.x * vi.x, image->sign.y * vi.y, image->sign.z * vi.z, vi.w};
            LaneVector part = {zero, zero, zero};
            friction_of(args, image->at, near, v, mi, half, &part);
            friction_of(args, image->at, neighbours_of_own_lanes(&own), v, mi, half, &part);
            sum.x += image->sign.x * part.x;
            sum.y += image->sign.y * part.y;
            sum.z += image->sign.z * part.z;
        }
        lanes_store(args->fx, i, begin, end, g * sum.x);
        lanes_store(args->fy, i, begin, end, g * sum.y);
        lanes_store(args->fz, i, begin, end, g * sum.z);
    }
}

/* --- solids --- */

/* Sums over boundary particles of F x, of F x x^T, and of F v . x with the velocity v of a boundary
   particle. */
typedef struct SolidSums {
    f8 x, y, z, xx, yy, zz, xy, yz, zx, flow;
} SolidSums;

/* `place` has 1 / m, 0 for solids; `motion`, if `flows`, velocities. */
SIMD_INLINE void add_boundary(const PairArgs *args, const uint32_t *j, const Separation *d,
                              const LaneVector *sign, f8 gradient, const bool flows, SolidSums *sum)
{
    const float h = args->constants->support_radius;
    const i8 solid = (d->term == f8_splat(0)) & (d->r2 < f8_splat(h * h));
    if (i8_bits(solid) == 0)
        return;
    const f8 q = f8_sqrt(d->r2) * f8_splat(1 / h);
    const f8 f = f8_masked(solid, gradient * shape(q, INCOMPRESSIBLE_KERNEL));
    const f8 x = sign->x * d->x, y = sign->y * d->y, z = sign->z * d->z, fx = f * x, fy = f * y, fz = f * z;
    sum->x += fx, sum->y += fy, sum->z += fz;
    sum->xx += fx * x, sum->yy += fy * y, sum->zz += fz * z;
    sum->xy += fx * y, sum->yz += fy * z, sum->zx += fz * x;
    if (flows) {
        const f8x4 v = motion(args, j);
        sum->flow += f * (v.x * d->x + v.y * d->y + v.z * d->z);
    }
}

SIMD_INLINE void add_boundary_images(const PairArgs *args, const WallsFar *far, size_t i, size_t begin,
                                     size_t end, f8 gradient, const bool flows, SolidSums *sum)
{
    const NeighbourRange near = neighbour_range_of(args, i);
    LaneImages images;
    if (!images_of(args, far, i, begin, end, &images))
        return;
    for (int m = 1; m <= images.count; m++) {
        const ImageParticle image = images.of[m];
        NEIGHBOURS (near, j) {
            const Separation d = separation(args, image.at, j);
            add_boundary(args, j, &d, &image.sign, gradient, flows, sum);
        }
    }
}

/* What solid_sums finds away from solids. */
SIMD_INLINE void solid_zeros(size_t i, size_t begin, size_t end, float *const *columns, float *flow)
{
    for (int k = SOLID_SLOPE; k <= SOLID_LIFT; k++)
        lanes_store(columns[k], i, begin, end, f8_splat(0));
    if (flow)
        lanes_store(flow, i, begin, end, f8_splat(0));
}

/* The sums of SolidColumn into `columns`, and sum F v . x into `flow`, unless NULL. `share`: k over p. */
SIMD_INLINE void solid_sums(const PairArgs *args, size_t begin, size_t end, float gradient, float share,
                            float *const *columns, float *flow)
{
    const Constants *s = args->constants;
    const WallsFar far = out_of_sight(s);
    const f8 one = f8_splat(1), zero = f8_splat(0), g = f8_splat(gradient), two = f8_splat(2),
             scale = f8_splat(share * s->rest_number_density),
             flat = f8_splat(1 / (float)(s->dimensions - 1));
    const LaneVector unturned = {one, one, one};
    GROUPS (i, begin, end) {
        const LaneVector at = place_of(args, i);
        const NeighbourRange near = neighbour_range_of(args, i);
        if (!near.solid) {
            solid_zeros(i, begin, end, columns, flow);
            continue;
        }
        SolidSums sum = {zero, zero, zero, zero, zero, zero, zero, zero, zero, zero};
        NEIGHBOURS (near, j) {
            Separation d = separation(args, at, j);
            if (__builtin_expect(near.coincident, 0))
                d = separate_to(args, i, j, d, TWINS_PART);
            add_boundary(args, j, &d, &unturned, g, flow != NULL, &sum);
        }
        add_boundary_images(args, &far, i, begin, end, g, flow != NULL, &sum);
        const f8 x = sum.x, y = sum.y, z = sum.z, square = x * x + y * y + z * z;
        const f8 squares = x * x * sum.xx + y * y * sum.yy + z * z * sum.zz +
                           two * (x * y * sum.xy + y * z * sum.yz + z * x * sum.zx);
        const i8 beside = square > zero;
        const f8 across = f8_masked(beside, squares / greater(square, f8_splat(1e-30f)));
        const f8 along = f8_masked(beside, sum.xx + sum.yy + sum.zz - across) * flat;
        lanes_store(columns[SOLID_SLOPE], i, begin, end, x);
        lanes_store(columns[SOLID_SLOPE + 1], i, begin, end, y);
        lanes_store(columns[SOLID_SLOPE + 2], i, begin, end, z);
        lanes_store(columns[SOLID_SHARE], i, begin, end, scale * along);
        lanes_store(columns[SOLID_LIFT], i, begin, end, scale * across);
        if (flow)
            lanes_store(flow, i, begin, end, sum.flow);
    }
}

#endif
