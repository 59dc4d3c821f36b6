// Whether a solver goes on, by what excess.comp has summed up behind its last iteration: substep_iterate of
// sim/world/iterate.c. One group.
#include "sim/constants.glsl"
#include "common/nan.glsl"
#include "shaders/sim/excess_part.h"
#include "shaders/sim/solve_block.h"
layout(std430, binding = PARTS_BUFFER) readonly buffer Parts { ExcessPart part[]; };
shared vec2 sums[64]; // sum, greatest

void decide(float mean, float greatest)
{
    iterations++;
    left_mean = mean;
    left_most = greatest;
    bool far = is_nan(mean) || mean > tolerance || (greatest > worst && iterations < iterations_few);
    if (iterations < iterations_most && far)
        return;
    ended = 1u;
    groups_along = groups_rows = 0u;
}

void main()
{
    uint own = gl_LocalInvocationID.x;
    sums[own] = vec2(part[own].above, part[own].greatest);
    for (uint half_count = 32u; half_count > 0u; half_count >>= 1u) {
        barrier();
        if (own < half_count)
            sums[own] = vec2(sums[own].x + sums[own + half_count].x, max(sums[own].y, sums[own + half_count].y));
    }
    if (own == 0u && ended == 0u)
        decide(sums[0].x / max(float(particles_there()), 1.0), sums[0].y);
}
