#include "eight.h"

#include <string.h>

void once_density(Cloud *cloud)
{
    const PairArgs *a = &cloud->args;
    const f8 inverse_h = f8_splat(1 / cloud->constants.support_radius);
    float *const density = a->number_density;
    for (size_t i = 0; i < a->count; i++)
        density[i] = 1;
    for (size_t i = 0; i < a->count; i++) {
        const uint32_t *list = cloud->index + cloud->first[i], *end = list + cloud->length[i];
        const Eight at = eight_times(a, i);
        f8 sum = f8_splat(0);
        for (const uint32_t *j = list; j < end; j += LANES) {
            const Eight other = eight_packed(a, j);
            const f8 term = near3(square(between(&at, &other)), inverse_h);
            sum += term;
            for (int k = 0; k < LANES; k++)
                density[j[k]] += term[k];
        }
        density[i] += f8_sum(sum);
    }
}

/* Takes the forces from eight particles, none of which but the last of all is there twice. */
SIMD_INLINE void react(float (*sum)[4], const uint32_t *j, Vector8 f)
{
    const __m256 x = (__m256)f.x, y = (__m256)f.y, z = (__m256)f.z, none = _mm256_setzero_ps();
    const __m256 xy = _mm256_unpacklo_ps(x, y), z0 = _mm256_unpacklo_ps(z, none);
    const __m256 XY = _mm256_unpackhi_ps(x, y), Z0 = _mm256_unpackhi_ps(z, none);
    const __m256 two[4] = {_mm256_shuffle_ps(xy, z0, 0x44), _mm256_shuffle_ps(xy, z0, 0xee),
                           _mm256_shuffle_ps(XY, Z0, 0x44), _mm256_shuffle_ps(XY, Z0, 0xee)};
    for (int k = 0; k < 4; k++) {
        float *low = sum[j[k]], *high = sum[j[k + 4]];
        _mm_store_ps(low, _mm_sub_ps(_mm_load_ps(low), _mm256_castps256_ps128(two[k])));
        _mm_store_ps(high, _mm_sub_ps(_mm_load_ps(high), _mm256_extractf128_ps(two[k], 1)));
    }
}

void once_force(Cloud *cloud)
{
    const PairArgs *a = &cloud->args;
    const f8 inverse_h = f8_splat(1 / cloud->constants.support_radius);
    float(*const sum)[4] = cloud->sum;
    memset(sum, 0, a->count * sizeof *sum);
    for (size_t i = 0; i < a->count; i++) {
        const uint32_t *list = cloud->index + cloud->first[i], *end = list + cloud->length[i];
        const Eight at = eight_times(a, i);
        Vector8 own = {f8_splat(0), f8_splat(0), f8_splat(0)};
        for (const uint32_t *j = list; j < end; j += LANES) {
            const Eight other = eight_packed(a, j);
            const Vector8 d = between(&at, &other), f = pair_force(&at, &other, d, square(d), inverse_h);
            own.x += f.x, own.y += f.y, own.z += f.z;
            react(sum, j, f);
        }
        a->fx[i] = sum[i][0] + f8_sum(own.x); /* those before i have done theirs */
        a->fy[i] = sum[i][1] + f8_sum(own.y);
        a->fz[i] = sum[i][2] + f8_sum(own.z);
    }
}
