// Begins another round of a solver that has ended where its lists became useless, from the sums of excess.comp over the way:
// substep_iterate of sim/step/iterate.c. A single group.
#include "sim/constants.glsl"
#include "common/nan.glsl"
#include "shaders/sim/excess_part.h"
#include "shaders/sim/solve_block.h"
layout(std430, binding = PARTS_BUFFER) readonly buffer Parts { ExcessPart part[]; };
shared float ways[64];

bool strays(float way)
{
    return ended != 0u && rounds + 1u < rounds_most && iterations < iterations_most && (is_nan(way) || way > way_most);
}

void begin_round()
{
    round_iterations[rounds++] = iterations;
    iterations_most -= iterations;
    iterations = 0xffffffffu; // the first measure adds 1
    ended = 0u;
    pass_groups.along = pass_groups_along;
    sum_groups.along = sum_groups_along;
    decision_groups.along = 1u;
}

void main()
{
    uint own = gl_LocalInvocationID.x;
    ways[own] = 0.0;
    for (uint k = own; k < sum_groups_along; k += 64u)
        ways[own] += part[sum_groups_along * EXCESS_OF_WAY + k].above;
    for (uint half_count = 32u; half_count > 0u; half_count >>= 1u) {
        barrier();
        if (own < half_count)
            ways[own] += ways[own + half_count];
    }
    if (own > 0u)
        return;
    bool again = strays(ways[0] / max(float(particles_there()), 1.0));
    renewal_groups.along = again ? renewal_groups_along : 0u;
    renewal_sum_groups.along = again ? sum_groups_along : 0u;
    renewal_decision_groups.along = again ? 1u : 0u;
    if (again)
        begin_round();
}
