// Those who stay, in their order; `before` is how many of them stand before each.
#include "sim/constants.glsl"
layout(std430, binding = 0) readonly buffer OldPositions { vec4 old_position[]; };
layout(std430, binding = 1) readonly buffer Before { uint before[]; };
layout(std430, binding = 2) readonly buffer OldVelocities { vec4 old_velocity[]; };
layout(std430, binding = 3) readonly buffer OldNames { uvec2 old_name[]; };
layout(std430, binding = 4) writeonly buffer Positions { vec4 position[]; };
layout(std430, binding = 5) writeonly buffer Velocities { vec4 velocity[]; };
layout(std430, binding = 6) writeonly buffer Names { uvec2 name[]; };

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
