// Insertion sort by id within each cell, so that sums have one order whatever the atomic counters did.
#include "sim/constants.glsl"
layout(std430, binding = 0) readonly buffer Names { uvec2 name[]; }; // id, fluid
layout(std430, binding = 2) readonly buffer Starts { uint start[]; };
layout(std430, binding = 3) buffer Orders { uint order[]; };

void main()
{
    uint c = invocation();
    if (c >= cell_count())
        return;
    uint first = start[c], end = start[c + 1u];
    for (uint i = first + 1u; i < end; i++) {
        uint moved = order[i], key = name[moved].x, j = i;
        for (; j > first && name[order[j - 1u]].x > key; j--)
            order[j] = order[j - 1u];
        order[j] = moved;
    }
}
