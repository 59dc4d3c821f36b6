/* Pair sums of implicit viscosity: see sim/methods/shared/terms.h. `place` has {x, mu}, `motion` {z, V},
   with -V for boundary particles. Where walls let fluid slip, images of fluid behind walls (sim/box/box.h)
   take part, with z in the mirror: symmetric and positive like pairs. */
#include "sim/cpu/pair_loop.h"
#include "sim/methods/shared/terms.h"

/* F R (mu_i + mu_j) V_j of a pair. */
SIMD_INLINE f8 weight(const PairArgs *args, Separation d, f8 mi, f8 volume, const ShapeKernel kernel)
{
    const f8 q = f8_sqrt(d.r2) * f8_splat(1 / args->constants->support_radius);
    return (args->viscosity ? harmonic(mi, d.term) : mi + mi) * volume *
           shape(greater(q, f8_splat(1e-6F)), kernel);
}

/* A symmetric matrix. */
typedef struct FrictionMatrix {
    f8 xx, yy, zz, xy, yz, zx;
} FrictionMatrix;

SIMD_INLINE void block_add(FrictionMatrix *sum, f8 c, Separation d)
{
    const f8 x = c * d.x, y = c * d.y, z = c * d.z;
    sum->xx += x * d.x, sum->yy += y * d.y, sum->zz += z * d.z;
    sum->xy += x * d.y, sum->yz += y * d.z, sum->zx += z * d.x;
}

SIMD_INLINE void block_store(float *const *column, size_t i, size_t begin, size_t end, f8 scale,
                             const FrictionMatrix *m)
{
    const f8 all[6] = {m->xx, m->yy, m->zz, m->xy, m->yz, m->zx};
    for (int k = 0; k < 6; k++)
        lanes_store(column[k], i, begin, end, scale * all[k]);
}

SIMD_INLINE void place_store(float *const *column, size_t i, size_t begin, size_t end, f8 scale,
                             LaneVector sum)
{
    lanes_store(column[0], i, begin, end, scale * sum.x);
    lanes_store(column[1], i, begin, end, scale * sum.y);
    lanes_store(column[2], i, begin, end, scale * sum.z);
}

/* Images of a group with friction; none where walls hold the fluid: there the walls' own friction is all. */
SIMD_INLINE bool rubbing_images(const PairArgs *args, const WallsFar *far, size_t i, size_t begin, size_t end,
                                LaneImages *images)
{
    return !args->constants->no_slip && images_of(args, far, i, begin, end, images);
}

SIMD_INLINE f8x4 in_mirror(f8x4 v, const ImageParticle *image)
{
    return (f8x4){image->sign.x * v.x, image->sign.y * v.y, image->sign.z * v.z, v.w};
}

SIMD_INLINE void place_add(LaneVector *sum, const ImageParticle *image, LaneVector part)
{
    sum->x += image->sign.x * part.x;
    sum->y += image->sign.y * part.y;
    sum->z += image->sign.z * part.z;
}

SIMD_INLINE void block_add_mirrored(FrictionMatrix *sum, const ImageParticle *image,
                                    const FrictionMatrix *part)
{
    const LaneVector sign = image->sign;
    sum->xx += part->xx, sum->yy += part->yy, sum->zz += part->zz;
    sum->xy += sign.x * sign.y * part->xy;
    sum->yz += sign.y * sign.z * part->yz;
    sum->zx += sign.z * sign.x * part->zx;
}

/* Explicit friction; sums of all blocks, and twice the sum of the blocks of solids. */
typedef struct PairSums {
    LaneVector force;
    FrictionMatrix all, held;
} PairSums;

SIMD_INLINE PairSums nothing_begun(void)
{
    const f8 zero = f8_splat(0);
    const FrictionMatrix none = {zero, zero, zero, zero, zero, zero};
    return (PairSums){{zero, zero, zero}, none, none};
}

SIMD_INLINE void begin_of(const PairArgs *args, const LaneVector at, const NeighbourRange near, f8 mi,
                          f8x4 vi, const ShapeKernel kernel, const bool solids, PairSums *sum)
{
    NEIGHBOURS (near, j) {
        const Separation d = separation(args, at, j);
        const f8x4 v = motion(args, j);
        const f8 c = weight(args, d, mi, solids ? greater(v.w, -v.w) : v.w, kernel);
        const f8 pull = c * ((v.x - vi.x) * d.x + (v.y - vi.y) * d.y + (v.z - vi.z) * d.z);
        sum->force.x += pull * d.x, sum->force.y += pull * d.y, sum->force.z += pull * d.z;
        block_add(&sum->all, c, d);
        if (solids)
            block_add(&sum->held, f8_masked(v.w < f8_splat(0), c + c), d);
    }
}

/* Explicit friction at the first velocities of the iterations into RESIDUAL, the sum of all blocks into
   INVERSE, twice that of solids into HELD. */
SIMD_INLINE void begin_range(const PairArgs *args, size_t begin, size_t end, const ShapeKernel kernel,
                             const bool solids)
{
    const Constants *s = args->constants;
    const WallsFar far = out_of_sight(s);
    LaneImages images;
    GROUPS (i, begin, end) {
        const NeighbourRange near = neighbour_range_of(args, i);
        const SelfLanes own = themselves(args, i);
        const f8 mi = f8_load(args->term[MISS] + i); /* viscosity of i, until the pass ends */
        const f8x4 vi = motion(args, own.j);
        PairSums sum = nothing_begun();
        begin_of(args, place_of(args, i), near, mi, vi, kernel, solids, &sum);
        const bool mirrored = rubbing_images(args, &far, i, begin, end, &images);
        for (int m = 1; mirrored && m <= images.count; m++) {
            const ImageParticle *image = &images.of[m];
            const f8x4 v = in_mirror(vi, image);
            PairSums part = nothing_begun();
            begin_of(args, image->at, near, mi, v, kernel, solids, &part);
            begin_of(args, image->at, neighbours_of_own_lanes(&own), mi, v, kernel, solids, &part);
            place_add(&sum.force, image, part.force);
            block_add_mirrored(&sum.all, image, &part.all);
            block_add_mirrored(&sum.held, image, &part.held);
        }
        const f8 scale = f8_splat(s->implicit.scale) * f8_load(args->volume + i);
        place_store(args->term + RESIDUAL, i, begin, end, scale, sum.force);
        block_store(args->term + INVERSE, i, begin, end, scale, &sum.all);
        if (solids)
            block_store(args->term + HELD, i, begin, end, scale, &sum.held);
    }
}

SIMD_INLINE void product_of(const PairArgs *args, const LaneVector at, const NeighbourRange near, f8 mi,
                            f8x4 z, const ShapeKernel kernel, LaneVector *sum)
{
    NEIGHBOURS (near, j) {
        const Separation d = separation(args, at, j);
        const f8x4 v = motion(args, j);
        const f8 pull =
            weight(args, d, mi, v.w, kernel) * ((z.x - v.x) * d.x + (z.y - v.y) * d.y + (z.z - v.z) * d.z);
        sum->x += pull * d.x, sum->y += pull * d.y, sum->z += pull * d.z;
    }
}

/* -L(z). */
SIMD_INLINE void product_range(const PairArgs *args, size_t begin, size_t end, const ShapeKernel kernel)
{
    const Constants *s = args->constants;
    const f8 zero = f8_splat(0);
    const WallsFar far = out_of_sight(s);
    LaneImages images;
    GROUPS (i, begin, end) {
        const NeighbourRange near = neighbour_range_of(args, i);
        const SelfLanes own = themselves(args, i);
        const f8x4 z = motion(args, own.j);
        const f8 mi = f8_load4(args->place, own.j).w;
        LaneVector sum = {zero, zero, zero};
        product_of(args, place_of(args, i), near, mi, z, kernel, &sum);
        const bool mirrored = rubbing_images(args, &far, i, begin, end, &images);
        for (int m = 1; mirrored && m <= images.count; m++) {
            const ImageParticle *image = &images.of[m];
            LaneVector part = {zero, zero, zero};
            product_of(args, image->at, near, mi, in_mirror(z, image), kernel, &part);
            product_of(args, image->at, neighbours_of_own_lanes(&own), mi, in_mirror(z, image), kernel,
                       &part);
            place_add(&sum, image, part);
        }
        place_store(args->term + PRODUCT, i, begin, end,
                    f8_splat(s->implicit.scale) * f8_load(args->volume + i), sum);
    }
}

#define FOR_KERNEL(body)                                                                                     \
    do {                                                                                                     \
        if (args->constants->implicit.kernel == KERNEL_WENDLAND_C2)                                          \
            body(args, begin, end, KERNEL_WENDLAND_C2);                                                      \
        else if (args->constants->implicit.kernel == KERNEL_QUINTIC)                                         \
            body(args, begin, end, KERNEL_QUINTIC);                                                          \
        else                                                                                                 \
            body(args, begin, end, KERNEL_CUBIC);                                                            \
    } while (0)

SIMD_INLINE void begin_among(const PairArgs *args, size_t begin, size_t end, const ShapeKernel kernel)
{
    if (args->constants->solid_count > 0)
        begin_range(args, begin, end, kernel, true);
    else
        begin_range(args, begin, end, kernel, false);
}

PAIR_LOOP(viscosity_sums)
{
    FOR_KERNEL(begin_among);
}

PAIR_LOOP(viscosity_products)
{
    FOR_KERNEL(product_range);
}
