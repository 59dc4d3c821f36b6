// Old indices of the particles in the order of cells.
#include "sim/constants.glsl"
layout(std430, binding = CELLS_BUFFER) readonly buffer Cells { uint cell[]; };
layout(std430, binding = RANKS_BUFFER) readonly buffer Ranks { uint rank[]; };
layout(std430, binding = STARTS_BUFFER) readonly buffer Starts { uint start[]; };
layout(std430, binding = ORDERS_BUFFER) writeonly buffer Orders { uint order[]; };

void main()
{
    uint i = invocation();
    if (i < particle_count())
        order[start[cell[i]] + rank[i]] = i;
}
