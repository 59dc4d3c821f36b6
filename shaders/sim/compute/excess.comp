// What of a column of scratch is above 0: each invocation adds up every 4096th particle, each group its invocations.
#include "sim/constants.glsl"
#include "sim/scratch.glsl"
#include "shaders/sim/excess_part.h"
layout(std430, binding = PARTS_BUFFER) writeonly buffer Parts { ExcessPart part[]; };
layout(location = COLUMN_AT) uniform uvec2 column;
shared vec2 sums[64]; // sum, greatest

void main()
{
    uint own = gl_LocalInvocationID.x;
    vec2 found = vec2(0);
    for (uint i = invocation(); i < particle_count(); i += 64u * gl_NumWorkGroups.x) {
        float value = scratch[column.x + i];
        found.x += value < 0.0 ? 0.0 : value; // NaN stays
        found.y = value > found.y ? value : found.y;
    }
    sums[own] = found;
    for (uint half_count = 32u; half_count > 0u; half_count >>= 1u) {
        barrier();
        if (own < half_count)
            sums[own] = vec2(sums[own].x + sums[own + half_count].x, max(sums[own].y, sums[own + half_count].y));
    }
    if (own == 0u)
        part[column.y + gl_WorkGroupID.x] = ExcessPart(sums[0].x, sums[0].y);
}
