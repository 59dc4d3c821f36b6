// Marks remaining particles, outside of all drains: fill_holds of sim/start/seed.c.
#include "sim/constants.glsl"
#include "shaders/sim/flow_block.h"
layout(std430, binding = POSITIONS_BUFFER) readonly buffer Positions { vec4 position[]; };
layout(std430, binding = MARKS_BUFFER) writeonly buffer Marks { uint mark[]; }; // the last is 0, for the total

bool drains_away(vec3 x)
{
    for (int k = 0; k < drain_total; k++) {
        Region region = drains[k];
        vec3 d = x - region.low;
        if (region.ball != 0 ? dot(d, d) <= region.radius2
                               : all(greaterThanEqual(x, region.low)) && all(lessThan(x, region.high)))
            return true;
    }
    return false;
}

void main()
{
    uint i = invocation();
    if (i < uint(mark.length()))
        mark[i] = i < particles_there() && !drains_away(position[i].xyz) ? 1u : 0u;
}
