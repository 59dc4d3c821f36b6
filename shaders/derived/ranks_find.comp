// One workgroup: finds the digit of each rank, and clears the bins.
#include "derived/ranks.glsl"
layout(local_size_x = 64) in;
const uint lane_bins = digit_bins / 64u;
shared uint part[4][64]; // sums of a lane's bins, per rank

uint rank_of(uint r, uint count)
{
    uint open = (count - 1u) / 100u; // values beyond a percentile
    return r == 0u ? 0u : r == 1u ? open : r == 2u ? count - 1u - open : count - 1u;
}

// The bin of `own` that contains the rank `place`; `place` becomes the rank within the bin.
uint bin_of(uint own, inout uint place)
{
    uint lane = 0u;
    while (lane < 63u && place >= part[own][lane])
        place -= part[own][lane++];
    uint bin = lane * lane_bins, last = bin + lane_bins - 1u;
    while (bin < last && place >= bins[own * digit_bins + bin])
        place -= bins[own * digit_bins + bin++];
    return bin;
}

void main()
{
    uint lane = gl_LocalInvocationID.x, result = 0u, place = 0u, count = 0u;
    for (uint r = 0u; r < 4u; r++) {
        part[r][lane] = 0u;
        for (uint k = 0u; k < lane_bins; k++)
            part[r][lane] += bins[r * digit_bins + lane * lane_bins + k];
    }
    barrier();
    if (lane < 4u) {
        uint own = digit == 0u ? 0u : lane;
        while (own > 0u && found[own] == found[own - 1u])
            own--;
        for (uint k = 0u; k < 64u; k++)
            count += part[0][k];
        place = digit > 0u ? left[lane] : count > 0u ? rank_of(lane, count) : 0u;
        uint higher = digit == 0u ? 0u : found[lane] << (digit == 2u ? 10u : 11u);
        result = higher | bin_of(own, place);
    }
    memoryBarrierBuffer();
    barrier();
    if (lane < 4u)
        found[lane] = result, left[lane] = place;
    if (lane == 0u && digit == 0u)
        known = count;
    for (uint k = lane; k < 4u * digit_bins; k += 64u)
        bins[k] = 0u;
}
