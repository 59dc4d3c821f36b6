// The cell of each particle, and the particle's place in the cell, in any order.
#include "sim/constants.glsl"
#include "sim/cells.glsl"
layout(std430, binding = POSITIONS_BUFFER) readonly buffer Positions { vec4 position[]; };
layout(std430, binding = CELLS_BUFFER) writeonly buffer Cells { uint cell[]; };
layout(std430, binding = RANKS_BUFFER) writeonly buffer Ranks { uint rank[]; };
layout(std430, binding = STARTS_BUFFER) buffer Counts { uint count[]; };

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    // Clamped, so that a non-finite position does no harm before the report.
    uint c = uint(cell_place(cell_of(position[i].xyz)));
    cell[i] = c;
    rank[i] = atomicAdd(count[c], 1u);
}
