// The acceleration in a step: end_body in sim/methods/shared/acceleration.c.
#include "sim/constants.glsl"
#include "sim/own.glsl"
layout(std430, binding = VELOCITIES_BUFFER) readonly buffer Velocities { vec4 velocity[]; };
layout(location = PASS_DT_AT) uniform float dt; // s; 0: unknown

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    for (uint k = 0u; k < 3u; k++) {
        uint at = OWN_change_acceleration + k * OWN_STRIDE + i;
        own[at] = dt > 0.0 ? (velocity[i][k] - own[at]) / dt : uintBitsToFloat(0x7fc00000u);
    }
}
