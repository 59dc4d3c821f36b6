// The particles' numbers in the order of their cells.
#include "common/neighbourhood_grid.glsl"
layout(std430, binding = 4) readonly buffer Cells { uint cell[]; };
layout(std430, binding = 5) readonly buffer Ranks { uint rank[]; };
layout(std430, binding = 6) readonly buffer Starts { uint start[]; };
layout(std430, binding = 7) writeonly buffer Orders { uint order[]; };

void main()
{
    uint i = invocation();
    if (i < grid_size.w)
        order[start[cell[i]] + rank[i]] = i;
}
