// pbf: a step's iterations begin with a part of the multipliers of the step before: begin_body in sim/methods/pbf/pbf_passes.c.
#include "shaders/sim/bindings.h"
layout(std430, binding = POSITIONS_BUFFER) readonly buffer Positions { vec4 position[]; };
#include "sim/pbf/list.glsl"
#include "sim/own.glsl"
#include "sim/scratch.glsl"
layout(std430, binding = NEAR_BUFFER) writeonly buffer Near { vec4 near[]; }; // w: growth of k, times dt^2
layout(location = PASS_DT_AT) uniform float dt;

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    vec3 x = position[i].xyz;
    float k = own[OWN_term + i] * (1.0 - min(FORGOTTEN, FORGOTTEN_RATE * (settle_rate * dt)));
    own[OWN_term + i] = k;
    for (uint a = 0u; a < 3u; a++)
        own[a * OWN_STRIDE + OWN_moved + i] = 0.0;
    scratch[SCRATCH_change + i] = scratch[SCRATCH_way + i] = 0.0;
    near[i] = vec4(x, dt * dt * k);
    make_list(i, x);
}
