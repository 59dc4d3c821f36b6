// Gathers the remaining particles in order; `before`: number of remaining particles before each particle.
#include "sim/constants.glsl"
layout(std430, binding = OLD_POSITIONS_BUFFER) readonly buffer OldPositions { vec4 old_position[]; };
layout(std430, binding = MARKS_BUFFER) readonly buffer Before { uint before[]; };
layout(std430, binding = OLD_VELOCITIES_BUFFER) readonly buffer OldVelocities { vec4 old_velocity[]; };
layout(std430, binding = OLD_NAMES_BUFFER) readonly buffer OldNames { uvec2 old_name[]; };
layout(std430, binding = POSITIONS_BUFFER) writeonly buffer Positions { vec4 position[]; };
layout(std430, binding = VELOCITIES_BUFFER) writeonly buffer Velocities { vec4 velocity[]; };
layout(std430, binding = NAMES_BUFFER) writeonly buffer Names { uvec2 name[]; };

void main()
{
    uint i = invocation();
    if (i >= particles_there() || before[i] == before[i + 1u])
        return;
    uint to = before[i];
    position[to] = old_position[i];
    velocity[to] = old_velocity[i];
    name[to] = old_name[i];
}
