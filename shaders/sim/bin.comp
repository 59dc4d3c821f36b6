// The cell of each particle, and its place there, in any order.
#include "sim/constants.glsl"
layout(std430, binding = 0) readonly buffer Positions { vec4 position[]; };
layout(std430, binding = 1) writeonly buffer Cells { uint cell[]; };
layout(std430, binding = 2) writeonly buffer Ranks { uint rank[]; };
layout(std430, binding = 3) buffer Counts { uint count[]; };

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    // Clamped, so that a position that is not finite does no harm before it is reported.
    ivec3 first = cell_first.xyz + 1, last = cell_first.xyz + cell_size.xyz - 2;
    uvec3 at = uvec3(clamp(ivec3(floor(position[i].xyz * kernel.y)), first, last) - first) + 1u;
    uint c = (at.z * uint(cell_size.y) + at.y) * uint(cell_size.x) + at.x;
    cell[i] = c;
    rank[i] = atomicAdd(count[c], 1u);
}
