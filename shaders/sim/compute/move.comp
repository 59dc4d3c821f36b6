// Particles into the order of their cells; behind a step that blew up nobody has made it, and they stay where they are.
#include "sim/constants.glsl"
layout(std430, binding = 0) readonly buffer Orders { uint order[]; };
layout(std430, binding = 1) readonly buffer OldPositions { vec4 old_position[]; };
layout(std430, binding = 2) readonly buffer OldVelocities { vec4 old_velocity[]; };
layout(std430, binding = 3) readonly buffer OldNames { uvec2 old_name[]; };
layout(std430, binding = 4) writeonly buffer Positions { vec4 position[]; };
layout(std430, binding = 5) writeonly buffer Velocities { vec4 velocity[]; };
layout(std430, binding = 6) writeonly buffer Names { uvec2 name[]; }; // id, fluid

void main()
{
    uint i = invocation();
    if (i >= particles_there())
        return;
    uint o = particle_count() > 0u ? order[i] : i;
    position[i] = old_position[o];
    velocity[i] = old_velocity[o];
    name[i] = old_name[o];
}
