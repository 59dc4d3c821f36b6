// Boundary particles in the order of their cells.
#include "sim/constants.glsl"
#include "sim/solids.glsl"
layout(std430, binding = 0) readonly buffer Cells { uint cell[]; };
layout(std430, binding = 1) readonly buffer Ranks { uint rank[]; };
layout(std430, binding = 2) readonly buffer Starts { uint start[]; };
layout(std430, binding = 3) writeonly buffer Orders { uint order[]; };

void main()
{
    uint b = invocation();
    if (b < uint(boundary_total))
        order[start[cell[b]] + rank[b]] = b;
}
