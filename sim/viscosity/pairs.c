/* The pair sums of implicit viscosity: see sim/viscosity/passes.h. `place` has {x, mu}, `motion` {z, V}; of
   boundary particles -V. */
#include "sim/cpu/pair_loop.h"
#include "sim/cpu/pair_shape.h"
#include "sim/viscosity/passes.h"

/* F R (mu_i + mu_j) V_j of a pair. */
SIMD_INLINE f8 weight(const Constants *s, Separation d, f8 mi, f8 volume, const ShapeKernel kernel)
{
    const f8 q = f8_sqrt(d.r2) * f8_splat(1 / s->support_radius);
    return (mi + d.term) * volume * shape(greater(q, f8_splat(1e-6F)), kernel);
}

/* A symmetric matrix. */
typedef struct Block {
    f8 xx, yy, zz, xy, yz, zx;
} Block;

SIMD_INLINE void block_add(Block *sum, f8 c, Separation d)
{
    const f8 x = c * d.x, y = c * d.y, z = c * d.z;
    sum->xx += x * d.x, sum->yy += y * d.y, sum->zz += z * d.z;
    sum->xy += x * d.y, sum->yz += y * d.z, sum->zx += z * d.x;
}

SIMD_INLINE void block_store(float *const *column, size_t i, size_t begin, size_t end, f8 scale,
                             const Block *m)
{
    const f8 all[6] = {m->xx, m->yy, m->zz, m->xy, m->yz, m->zx};
    for (int k = 0; k < 6; k++)
        lanes_store(column[k], i, begin, end, scale * all[k]);
}

SIMD_INLINE void place_store(float *const *column, size_t i, size_t begin, size_t end, f8 scale, Place sum)
{
    lanes_store(column[0], i, begin, end, scale * sum.x);
    lanes_store(column[1], i, begin, end, scale * sum.y);
    lanes_store(column[2], i, begin, end, scale * sum.z);
}

/* Explicit friction into the residual, the sum of all blocks into INVERSE. */
SIMD_INLINE void begin_range(const PairArgs *args, size_t begin, size_t end, const ShapeKernel kernel,
                             const bool solids)
{
    const Constants *s = args->constants;
    const f8 zero = f8_splat(0);
    GROUPS (i, begin, end) {
        const Place at = place_of(args, i);
        const Near near = near_of(args, i);
        const f8 mi = f8_load(args->term[MISS] + i); /* its viscosity, until the pass ends */
        const f8 vx = f8_load(args->vx + i), vy = f8_load(args->vy + i), vz = f8_load(args->vz + i);
        Place force = {zero, zero, zero};
        Block all = {zero, zero, zero, zero, zero, zero}, held = all;
        NEIGHBOURS (near, j) {
            const Separation d = separation(args, at, j);
            const f8x4 v = motion(args, j);
            const f8 c = weight(s, d, mi, solids ? greater(v.w, -v.w) : v.w, kernel);
            const f8 pull = c * ((v.x - vx) * d.x + (v.y - vy) * d.y + (v.z - vz) * d.z);
            force.x += pull * d.x, force.y += pull * d.y, force.z += pull * d.z;
            block_add(&all, c, d);
            if (solids)
                block_add(&held, f8_masked(v.w < zero, c + c), d);
        }
        const f8 scale = f8_splat(s->implicit.scale) * f8_load(args->volume + i);
        place_store(args->term + RESIDUAL, i, begin, end, scale, force);
        block_store(args->term + INVERSE, i, begin, end, scale, &all);
        if (solids)
            block_store(args->term + HELD, i, begin, end, scale, &held);
    }
}

/* -L(z). */
SIMD_INLINE void product_range(const PairArgs *args, size_t begin, size_t end, const ShapeKernel kernel)
{
    const Constants *s = args->constants;
    const f8 zero = f8_splat(0);
    GROUPS (i, begin, end) {
        const Place at = place_of(args, i);
        const Near near = near_of(args, i);
        uint32_t own[LANES];
        for (uint32_t k = 0; k < LANES; k++)
            own[k] = i + k < args->count ? (uint32_t)i + k : (uint32_t)args->count;
        const f8x4 z = motion(args, own);
        const f8 mi = f8_load4(args->place, own).w;
        Place force = {zero, zero, zero};
        NEIGHBOURS (near, j) {
            const Separation d = separation(args, at, j);
            const f8x4 v = motion(args, j);
            const f8 pull =
                weight(s, d, mi, v.w, kernel) * ((z.x - v.x) * d.x + (z.y - v.y) * d.y + (z.z - v.z) * d.z);
            force.x += pull * d.x, force.y += pull * d.y, force.z += pull * d.z;
        }
        place_store(args->term + PRODUCT, i, begin, end,
                    f8_splat(s->implicit.scale) * f8_load(args->volume + i), force);
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
