// dfsph: positions move by the result of the solver of density: density_end in sim/methods/dfsph/dfsph_passes.c.
#include "sim/constants.glsl"
#include "sim/place.glsl"
#include "shaders/sim/dfsph/dfsph_block.h"
layout(std430, binding = POSITIONS_BUFFER) buffer Positions { vec4 position[]; };
layout(std430, binding = PUSHES_BUFFER) readonly buffer Pushes { vec4 push[]; }; // accelerations, k
layout(location = PASS_DT_AT) uniform float dt;

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    vec3 way = push[i].xyz * (dt * dt);
    float size = length(way), most = MOVE_MOST * spacing;
    position[i].xyz = place_after(i, position[i].xyz, size > most ? most / size * way : way);
}
