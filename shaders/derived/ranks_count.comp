// One invocation per particle, or of the first digit per RANKS_A_LANE particles. Values that are not finite are left out.
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

bool is_finite(float value) { return (floatBitsToUint(value) & 0x7f800000u) != 0x7f800000u; }

// The highest digit of RANKS_A_LANE values: most particles have one of few digits. A lane counts equal digits that follow
// each other, before it adds to memory that all lanes add to.
void count_first(uint lane, uint lanes)
{
    uint place = 0u, times = 0u;
    for (uint i = lane; i < grid_particles; i += lanes) {
        float value = scalar_words[i * scalar_stride];
        if (!is_finite(value))
            continue;
        uint next = in_order(value) >> digit_shift() & 2047u;
        if (next != place && times > 0u) {
            atomicAdd(bins[place], times);
            times = 0u;
        }
        place = next;
        times++;
    }
    if (times > 0u)
        atomicAdd(bins[place], times);
}

void main()
{
    uint i = invocation(), lanes = (grid_particles + RANKS_A_LANE - 1u) / RANKS_A_LANE;
    if (digit == 0u) {
        if (i < lanes)
            count_first(i, lanes);
        return;
    }
    if (i >= grid_particles)
        return;
    float value = scalar_words[i * scalar_stride];
    if (!is_finite(value))
        return;
    uint key = in_order(value) >> digit_shift(), place = key & (digit == 2u ? 1023u : 2047u);
    uint higher = key >> (digit == 2u ? 10u : 11u);
    for (uint r = 0u; r < 4u; r++)
        if (higher == found[r] && (r == 0u || found[r - 1u] != higher))
            atomicAdd(bins[r * digit_bins + place], 1u);
}
