// Position and cell of each boundary particle. The last cell, which is never read, is for particles beyond walls,
// where the walls act, and for matter of overlapping solids, which counts once, for the first solid.
// sim/cpu/boundary.c.
#include "sim/constants.glsl"
#include "sim/in_box.glsl"
#include "sim/solids.glsl"
#include "sim/cells.glsl"
layout(std430, binding = RESTS_BUFFER) readonly buffer Rests { vec4 rest[]; }; // in the solid's frame; w: solid
layout(std430, binding = CELLS_BUFFER) writeonly buffer Cells { uint cell[]; };
layout(std430, binding = RANKS_BUFFER) writeonly buffer Ranks { uint rank[]; };
layout(std430, binding = STARTS_BUFFER) buffer Counts { uint count[]; };

void main()
{
    uint b = invocation();
    if (b >= uint(boundary_total))
        return;
    int solid = int(rest[b].w);
    vec3 x = solid_to_box(solids[solid].end, rest[b].xyz);
    bool aside = !in_the_box(x);
    for (int k = 0; k < solid; k++)
        aside = aside || solid_clearance(k, x, 0.0) < 0.0;
    uint c = aside ? cell_count() : uint(cell_place(cell_of(x)));
    cell[b] = c;
    rank[b] = atomicAdd(count[c], 1u);
}
