// dfsph: the solver of density begins with no k: density_begin in sim/dfsph/passes.c.
#include "sim/constants.glsl"
#include "sim/scratch.glsl"
layout(std430, binding = NEAR_BUFFER) writeonly buffer Near { vec4 near[]; }; // w: k

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    near[i].w = 0.0;
    scratch[SCRATCH_change + i] = 0.0;
}
