// dfsph: positions move by the result of the solver of density: density_end in sim/methods/dfsph/dfsph_passes.c.
#include "sim/constants.glsl"
#include "sim/own.glsl"
#include "sim/place.glsl"
#include "shaders/sim/dfsph/dfsph_block.h"
layout(std430, binding = POSITIONS_BUFFER) buffer Positions { vec4 position[]; };
layout(std430, binding = PUSHES_BUFFER) readonly buffer Pushes { vec4 push[]; }; // accelerations, k
layout(location = PASS_DT_AT) uniform float dt;
#ifdef SOLIDS
#include "sim/scratch.glsl"
layout(std430, binding = MOVES_BUFFER) readonly buffer Moves { vec4 move[]; }; // velocities, volume

// fill_boundary_part in sim/methods/dfsph/dfsph_passes.c.
float boundary_part_of(uint i)
{
    vec3 slope = column_of(SCRATCH_solid_slope, i);
    float flow = scratch[SCRATCH_solid_flow + i] - dot(move[i].xyz, slope);
    float now = (own[OWN_boundary_part + i] + dt / rest_number_density * flow) / (1.0 + dt * boundary_fades);
    return dot(slope, slope) > 0.0 ? clamp(now, -BOUNDARY_MOST, BOUNDARY_MOST) : 0.0;
}
#endif

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
#ifdef SOLIDS
    own[OWN_boundary_part + i] = boundary_part_of(i);
#endif
    vec3 way = push[i].xyz * (dt * dt);
    float size = length(way), most = MOVE_MOST * spacing;
    position[i].xyz = place_after(i, position[i].xyz, size > most ? most / size * way : way);
}
