// Boundary particles in the order of their cells.
#include "sim/constants.glsl"
#include "sim/solids.glsl"
layout(std430, binding = CELLS_BUFFER) readonly buffer Cells { uint cell[]; };
layout(std430, binding = RANKS_BUFFER) readonly buffer Ranks { uint rank[]; };
layout(std430, binding = STARTS_BUFFER) readonly buffer Starts { uint start[]; };
layout(std430, binding = ORDERS_BUFFER) writeonly buffer Orders { uint order[]; };

void main()
{
    uint b = invocation();
    if (b < uint(boundary_total))
        order[start[cell[b]] + rank[b]] = b;
}
