#include "eight.h"

SIMD_INLINE Eight eight_of(const PairArgs *a, const uint32_t *j, const bool packed)
{
    return packed ? eight_packed(a, j) : eight_gathered(a, j);
}

SIMD_INLINE void density(Cloud *cloud, const bool packed)
{
    const PairArgs *a = &cloud->args;
    const f8 inverse_h = f8_splat(1 / cloud->constants.support_radius);
    for (size_t i = 0; i < a->count; i++) {
        const uint32_t *list = cloud->index + cloud->first[i], *end = list + cloud->length[i];
        const Eight at = eight_times(a, i);
        f8 sum = f8_splat(0);
        for (const uint32_t *j = list; j < end; j += LANES) {
            const Eight other = eight_of(a, j, packed);
            sum += near3(square(between(&at, &other)), inverse_h);
        }
        a->number_density[i] = 1 + f8_sum(sum);
    }
}

SIMD_INLINE void force(Cloud *cloud, const bool packed)
{
    const PairArgs *a = &cloud->args;
    const f8 inverse_h = f8_splat(1 / cloud->constants.support_radius);
    for (size_t i = 0; i < a->count; i++) {
        const uint32_t *list = cloud->index + cloud->first[i], *end = list + cloud->length[i];
        const Eight at = eight_times(a, i);
        Vector8 sum = {f8_splat(0), f8_splat(0), f8_splat(0)};
        for (const uint32_t *j = list; j < end; j += LANES) {
            const Eight other = eight_of(a, j, packed);
            const Vector8 d = between(&at, &other), f = pair_force(&at, &other, d, square(d), inverse_h);
            sum.x += f.x, sum.y += f.y, sum.z += f.z;
        }
        a->fx[i] = f8_sum(sum.x), a->fy[i] = f8_sum(sum.y), a->fz[i] = f8_sum(sum.z);
    }
}

void gathered_density(Cloud *cloud)
{
    density(cloud, false);
}

void gathered_force(Cloud *cloud)
{
    force(cloud, false);
}

void packed_density(Cloud *cloud)
{
    density(cloud, true);
}

void packed_force(Cloud *cloud)
{
    force(cloud, true);
}
