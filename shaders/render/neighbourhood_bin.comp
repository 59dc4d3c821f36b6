// The cell of each particle, and a rank in the cell, in any order.
#include "common/particles.glsl"
#include "common/neighbourhood_grid.glsl"
layout(std430, binding = CELLS_STORAGE) writeonly buffer Cells { uint cell[]; };
layout(std430, binding = RANKS_STORAGE) writeonly buffer Ranks { uint rank[]; };
layout(std430, binding = STARTS_STORAGE) buffer Counts { uint count[]; };

void main()
{
    uint i = invocation();
    if (i >= grid_particles)
        return;
    vec3 x = particle_position(i);
    uint c = beside_grid(x) ? grid_size.x * grid_size.y * grid_size.z : cell_number(cell_at(x));
    cell[i] = c;
    rank[i] = atomicAdd(count[c], 1u);
}
