// Sums the positive part of a scratch column, and for a residual of conjugate gradients two further columns. Each
// invocation adds particles as far apart as there are invocations, each group its invocations.
#include "sim/constants.glsl"
#include "sim/scratch.glsl"
#include "shaders/sim/excess_part.h"
layout(std430, binding = PARTS_BUFFER) writeonly buffer Parts { ExcessPart part[]; };
layout(location = COLUMN_AT) uniform uvec4 column; // y: index of the first part
shared vec4 sums[64];                              // sum, greatest, power, curvature

void main()
{
    uint own = gl_LocalInvocationID.x, count = particle_count();
    vec4 found = vec4(0);
    for (uint i = invocation(); i < count; i += 64u * gl_NumWorkGroups.x) {
        float value = scratch[column.x + i];
        found.x += value < 0.0 ? 0.0 : value; // NaN stays
        found.y = value > found.y ? value : found.y;
        if (column.z != EXCESS_NO_COLUMN)
            found.zw += vec2(scratch[column.z + i], scratch[column.w + i]);
    }
    sums[own] = found;
    for (uint half_count = 32u; half_count > 0u; half_count >>= 1u) {
        barrier();
        if (own < half_count) {
            vec4 one = sums[own], other = sums[own + half_count];
            sums[own] = vec4(one.x + other.x, max(one.y, other.y), one.zw + other.zw);
        }
    }
    if (own == 0u)
        part[column.y + gl_WorkGroupID.x] = ExcessPart(sums[0].x, sums[0].y, sums[0].z, sums[0].w);
}
