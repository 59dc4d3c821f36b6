// Keeps the velocity at the begin of a step: begin_body in sim/methods/shared/acceleration.c.
#include "sim/constants.glsl"
#define OWN_ACCESS writeonly
#include "sim/own.glsl"
layout(std430, binding = VELOCITIES_BUFFER) readonly buffer Velocities { vec4 velocity[]; };

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    for (uint k = 0u; k < 3u; k++)
        own[OWN_change_acceleration + k * OWN_STRIDE + i] = velocity[i][k];
}
