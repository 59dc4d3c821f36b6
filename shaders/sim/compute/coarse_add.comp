// The coarse level: adds the nodes' values to the particles' multipliers: add_range of sim/cpu/coarse.c.
#include "sim/constants.glsl"
#include "sim/cells.glsl"
#include "sim/coarse.glsl"
layout(std430, binding = NEAR_BUFFER) buffer Near { vec4 near[]; };                          // w: k
layout(std430, binding = COARSE_TERMS_BUFFER) readonly buffer CoarseTerms { vec4 term[]; };  // weight, hold, residual
layout(std430, binding = COARSE_NODES_BUFFER) readonly buffer CoarseNodes { float node[]; }; // values first

void main()
{
    uint i = invocation();
    if (i >= particle_count() || term[i].x <= 0.0)
        return;
    vec4 place = near[i];
    ivec3 cell = coarse_cell_of(cell_of(place.xyz));
    vec3 at = coarse_place(place.xyz, cell);
    for (int c = 0; c < COARSE_CORNERS; c++) {
        vec3 part = mix(1.0 - at, at, notEqual(ivec3(c) & ivec3(1, 2, 4), ivec3(0)));
        place.w += part.x * part.y * part.z * node[coarse_node(cell, c)];
    }
#ifndef NEGATIVE_PRESSURE
    place.w = max(place.w, 0.0);
#endif
    near[i].w = place.w;
}
