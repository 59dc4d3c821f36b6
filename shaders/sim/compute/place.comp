// Old places of the particles in the order of their cells.
#include "sim/constants.glsl"
layout(std430, binding = 0) readonly buffer Cells { uint cell[]; };
layout(std430, binding = 1) readonly buffer Ranks { uint rank[]; };
layout(std430, binding = 2) readonly buffer Starts { uint start[]; };
layout(std430, binding = 3) writeonly buffer Orders { uint order[]; };

void main()
{
    uint i = invocation();
    if (i < particle_count())
        order[start[cell[i]] + rank[i]] = i;
}
