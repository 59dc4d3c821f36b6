// Moves boundary particles to their places; for reproducible worlds by number within each cell: sort.comp.
#include "sim/constants.glsl"
#include "sim/solids.glsl"
#define BOUNDARY_ACCESS writeonly
#include "sim/boundary.glsl"
layout(std430, binding = RESTS_BUFFER) readonly buffer Rests { vec4 rest[]; };
layout(std430, binding = ORDERS_BUFFER) buffer Orders { uint order[]; };

void main()
{
    uint c = invocation();
    if (c >= cell_count())
        return;
    uint first = boundary_start[c], end = boundary_start[c + 1u];
#ifdef REPRODUCIBLE
    for (uint i = first + 1u; i < end; i++) {
        uint moved = order[i], j = i;
        for (; j > first && order[j - 1u] > moved; j--)
            order[j] = order[j - 1u];
        order[j] = moved;
    }
#endif
    for (uint i = first; i < end; i++) {
        vec4 at = rest[order[i]];
        boundary_position[i] = vec4(solid_to_box(solids[int(at.w)].end, at.xyz), 0.0);
        boundary_velocity[i] = vec4(0);
        boundary_state[i] = uvec2(0u, order[i]);
    }
}
