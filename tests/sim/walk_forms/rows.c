#include "eight.h"

/* r^2 of the eight from j on, and of those that are no others of the run far more than h^2. */
SIMD_INLINE f8 squares(const Eight *at, const Eight *other, size_t i, uint32_t j, uint32_t end)
{
    const i8 there = lane_index < i8_splat((int32_t)(end - j)),
             self = lane_index == i8_splat((int32_t)(i - j));
    return f8_select(there & ~self, square(between(at, other)), f8_splat(PAST));
}

void rows_density(Cloud *cloud)
{
    const PairArgs *a = &cloud->args;
    const f8 inverse_h = f8_splat(1 / cloud->constants.support_radius);
    Run runs[RUNS];
    int count = 0;
    for (size_t i = 0; i < a->count; i++) {
        if (i == 0 || a->cell[i] != a->cell[i - 1])
            count = cloud_runs(cloud, i, runs);
        const Eight at = eight_times(a, i);
        f8 sum = f8_splat(0);
        for (const Run *run = runs; run < runs + count; run++)
            for (uint32_t j = run->begin; j < run->end; j += LANES) {
                const Eight other = eight_from(a, j);
                sum += near3(squares(&at, &other, i, j, run->end), inverse_h);
            }
        a->number_density[i] = 1 + f8_sum(sum);
    }
}

/* Adds what the particles of one run do to i. */
SIMD_INLINE void run_force(const PairArgs *a, size_t i, const Eight *at, Run run, Vector8 *sum)
{
    const float h = a->constants->support_radius;
    for (uint32_t j = run.begin; j < run.end; j += LANES) {
        const Eight other = eight_from(a, j);
        const f8 r2 = squares(at, &other, i, j, run.end);
        if (!i8_bits(r2 < f8_splat(h * h)))
            continue;
        const Vector8 f = pair_force(at, &other, between(at, &other), r2, f8_splat(1 / h));
        sum->x += f.x, sum->y += f.y, sum->z += f.z;
    }
}

void rows_force(Cloud *cloud)
{
    const PairArgs *a = &cloud->args;
    Run runs[RUNS];
    int count = 0;
    for (size_t i = 0; i < a->count; i++) {
        if (i == 0 || a->cell[i] != a->cell[i - 1])
            count = cloud_runs(cloud, i, runs);
        const Eight at = eight_times(a, i);
        Vector8 sum = {f8_splat(0), f8_splat(0), f8_splat(0)};
        for (const Run *run = runs; run < runs + count; run++)
            run_force(a, i, &at, *run, &sum);
        a->fx[i] = f8_sum(sum.x), a->fy[i] = f8_sum(sum.y), a->fz[i] = f8_sum(sum.z);
    }
}
