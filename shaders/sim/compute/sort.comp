// The place of each particle in its cell, by id, so that sums have a fixed order for any result of the atomic
// counters. Each invocation counts for itself: a sort in a cell of many particles would be a long loop, and llvmpipe
// stops loops after 65,535 rounds.
#include "sim/constants.glsl"
layout(std430, binding = NAMES_BUFFER) readonly buffer Names { uvec2 name[]; }; // id, fluid
layout(std430, binding = CELLS_BUFFER) readonly buffer Cells { uint cell[]; };
layout(std430, binding = STARTS_BUFFER) readonly buffer Starts { uint start[]; };
layout(std430, binding = ORDERS_BUFFER) readonly buffer Orders { uint order[]; };
layout(std430, binding = SORTED_BUFFER) writeonly buffer Sorted { uint sorted[]; };

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    uint first = start[cell[i]], end = start[cell[i] + 1u], id = name[i].x, place = first;
    for (uint j = first; j < end; j++)
        place += uint(name[order[j]].x < id);
    sorted[place] = i;
}
