// The particles' numbers in the order of their cells.
#include "common/neighbourhood_grid.glsl"
layout(std430, binding = CELLS_STORAGE) readonly buffer Cells { uint cell[]; };
layout(std430, binding = RANKS_STORAGE) readonly buffer Ranks { uint rank[]; };
layout(std430, binding = STARTS_STORAGE) readonly buffer Starts { uint start[]; };
layout(std430, binding = ORDER_STORAGE) writeonly buffer Orders { uint order[]; };

void main()
{
    uint i = invocation();
    if (i < grid_particles)
        order[start[cell[i]] + rank[i]] = i;
}
