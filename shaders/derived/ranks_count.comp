// One invocation per particle. Values that are not finite are left out.
#include "common/particle_scalars.glsl"
#include "common/neighbourhood_grid.glsl"
#include "derived/ranks.glsl"
layout(location = SCALAR_STRIDE_AT) uniform uint scalar_stride; // words

// Bits that are ordered like the numbers.
uint in_order(float value)
{
    uint bits = floatBitsToUint(value);
    return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}

void main()
{
    uint i = invocation();
    if (i >= grid_particles)
        return;
    float value = scalar_words[i * scalar_stride];
    if ((floatBitsToUint(value) & 0x7f800000u) == 0x7f800000u)
        return;
    uint key = in_order(value) >> digit_shift(), place = key & (digit == 2u ? 1023u : 2047u);
    if (digit == 0u) {
        atomicAdd(bins[place], 1u);
        return;
    }
    uint higher = key >> (digit == 2u ? 10u : 11u);
    for (uint r = 0u; r < 4u; r++)
        if (higher == found[r] && (r == 0u || found[r - 1u] != higher))
            atomicAdd(bins[r * digit_bins + place], 1u);
}
