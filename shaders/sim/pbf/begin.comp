// pbf: a step's iterations begin with a part of the multipliers of the step before: begin_body in sim/methods/pbf/pbf_passes.c.
#include "shaders/sim/bindings.h"
layout(std430, binding = POSITIONS_BUFFER) readonly buffer Positions { vec4 position[]; };
#include "sim/pbf/list.glsl"
#include "sim/own.glsl"
#include "sim/scratch.glsl"
layout(std430, binding = NEAR_BUFFER) writeonly buffer Near { vec4 near[]; }; // w: growth of k, times dt^2
layout(location = PASS_DT_AT) uniform float dt;

// x before the fall of a step at rest in the box, as far as the walls let: rise_run.
vec3 unfallen(vec3 x)
{
    precise vec3 fall = dt * dt * apparent_at(x), to = x - fall; // as the cpu rounds
#ifdef PERIODIC
    bvec3 open = bvec3(periodic[0], periodic[1], periodic[2]);
#else
    bvec3 open = bvec3(false);
#endif
    open.z = open.z || dimensions == 2;
    for (uint a = 0u; a < 3u; a++) {
        float low = a == 1u ? 0.0 : -half_size[a];
        to[a] = open[a] || (to[a] > low && to[a] < low + 2.0 * half_size[a]) ? to[a] : x[a];
    }
    return to;
}

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
#ifdef SOLIDS
    for (uint a = 0u; a < 3u; a++)
        own[a * OWN_STRIDE + OWN_solid_by + i] = 0.0;
#endif
    scratch[SCRATCH_change + i] = scratch[SCRATCH_way + i] = 0.0;
    near[i] = vec4(unfallen(x), dt * dt * k);
    make_list(i, x);
}
