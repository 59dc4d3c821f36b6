// dfsph: the solver of divergence begins with k of the step before.
#define OWN_ACCESS readonly
#include "sim/constants.glsl"
#include "sim/own.glsl"
#include "sim/scratch.glsl"
layout(std430, binding = NEAR_BUFFER) writeonly buffer Near { vec4 near[]; }; // w: k

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    float k = own[OWN_kept_term + i];
#ifndef NEGATIVE_PRESSURE
    k = k > 0.0 ? k : 0.0;
#endif
    near[i].w = k;
    scratch[SCRATCH_change + i] = k - own[OWN_kept_term + i];
}
