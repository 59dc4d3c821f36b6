// pbf: effect of gravity on a free flight, in the middle of the flight: predict_body in sim/methods/pbf/pbf_passes.c.
#include "sim/constants.glsl"
#include "sim/place.glsl"
layout(std430, binding = POSITIONS_BUFFER) buffer Positions { vec4 position[]; };
layout(std430, binding = VELOCITIES_BUFFER) buffer Velocities { vec4 velocity[]; };
layout(location = PASS_DT_AT) uniform float dt;

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    vec3 fall = 0.5 * dt * dt * kick_gravity;
    velocity[i].xyz += dt * kick_gravity - cross(apparent_omega, fall);
    position[i].xyz = place_after(i, position[i].xyz, fall);
}
