// Where each boundary particle is now, and its cell: the last one, which nobody reads, for what is behind walls, where the
// walls' own stand, and for matter that solids share, which counts once, for the first of them. sim/cpu/boundary.c.
#include "sim/constants.glsl"
#include "sim/in_box.glsl"
#include "sim/solids.glsl"
#include "sim/cells.glsl"
layout(std430, binding = RESTS_BUFFER) readonly buffer Rests { vec4 rest[]; }; // in the solid's frame; w: which solid
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
