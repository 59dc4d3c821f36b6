// Appends the candidates with room to the particles; `before`: sum of the marks before each candidate.
#include "sim/constants.glsl"
#include "shaders/sim/flow_block.h"
#include "shaders/sim/flow_counts_block.h"
#ifdef OWN_TOTAL
#define OWN_ACCESS writeonly
#include "sim/own.glsl"
#endif
layout(std430, binding = POSITIONS_BUFFER) writeonly buffer Positions { vec4 position[]; };
layout(std430, binding = LAYER_BUFFER) readonly buffer Layer { float candidates[]; };
layout(std430, binding = VELOCITIES_BUFFER) writeonly buffer Velocities { vec4 velocity[]; };
layout(std430, binding = MARKS_BUFFER) readonly buffer Before { uint before[]; };
layout(std430, binding = NAMES_BUFFER) writeonly buffer Names { uvec2 name[]; };

void main()
{
    uint k = invocation();
    if (k >= candidate_total || before[k] == before[k + 1u] || particles_there() + before[k] >= particle_most)
        return;
    uint i = particles_there() + before[k];
    position[i] = vec4(candidates[3u * k], candidates[3u * k + 1u], candidates[3u * k + 2u], 0.0);
    velocity[i] = vec4(layer_velocity, 0.0);
    name[i] = uvec2(born + before[k], layer_fluid);
#ifdef OWN_TOTAL
    for (uint at = 0u; at < OWN_TOTAL * OWN_STRIDE; at += OWN_STRIDE)
        own[at + i] = 0.0;
#endif
}
