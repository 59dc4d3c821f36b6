// The number of particles behind a layer or a drain. A single invocation.
#include "sim/constants.glsl"
#include "shaders/sim/flow_block.h"
#include "shaders/sim/flow_counts_block.h"
layout(std430, binding = MARKS_BUFFER) readonly buffer Before { uint before[]; };
layout(location = FLOW_AT) uniform uvec3 flow;

void main()
{
    if (invocation() > 0u)
        return;
    bool drains_away = flow.z != 0u;
    uint marked = min(before[flow.y], flow.y), total = particles_there();
    uint changed = drains_away ? total - min(marked, total) : min(marked, particle_most - min(total, particle_most));
    there = drains_away ? total - changed : total + changed;
    born += drains_away ? 0u : changed;
    flowed[flow.x] += changed;
}
