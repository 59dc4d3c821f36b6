// pbf: number density and pressure of a loaded state: settle_body in sim/methods/pbf/pbf_passes.c.
#define LISTS_FIRST
#define OWN_ACCESS readonly
#include "shaders/sim/pbf/pbf_block.h"
layout(std430, binding = POSITIONS_BUFFER) buffer Positions { vec4 position[]; };             // w: volume, m3
layout(std430, binding = PRESSURES_BUFFER) writeonly buffer Pressures { vec2 pressure[]; };   // p, k
layout(std430, binding = VELOCITIES_BUFFER) writeonly buffer Velocities { vec4 velocity[]; }; // w: volume
#include "sim/incompressible/sums.glsl"
#include "sim/own.glsl"

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    walk_pairs(i, position[i].xyz);
    float n = kernel_scale * heights, ratio = n / rest_number_density, volume = 1.0 / n;
    position[i].w = unit_volume * volume;
    velocity[i].w = volume;
    pressure[i] = vec2(pressure_of_term * ratio * ratio * own[OWN_term + i], 0.0);
}
