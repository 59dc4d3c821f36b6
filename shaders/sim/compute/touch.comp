// A finger in the fluid: sim/world.h.
#include "sim/constants.glsl"
#include "sim/cells.glsl"
#include "sim/finger.glsl"
layout(std430, binding = POSITIONS_BUFFER) readonly buffer Positions { vec4 position[]; };
layout(std430, binding = VELOCITIES_BUFFER) buffer Velocities { vec4 velocity[]; };
layout(location = FINGER_AT) uniform vec4 finger_at; // w: 1 / radius^2
layout(location = FINGER_VELOCITY_AT) uniform vec4 finger_velocity;
layout(location = FINGER_KICK_AT) uniform float finger_kick;

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    vec3 d = nearest(position[i].xyz - finger_at.xyz);
    velocity[i].xyz = finger_moved(velocity[i].xyz, d, finger_at.w, finger_velocity, finger_kick);
}
