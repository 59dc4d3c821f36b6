// pbf: goes on with another grid: again_body in sim/methods/pbf/pbf_passes.c.
#include "shaders/sim/bindings.h"
layout(std430, binding = POSITIONS_BUFFER) readonly buffer Positions { vec4 position[]; };
#include "sim/pbf/list.glsl"
#include "sim/scratch.glsl"

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    scratch[SCRATCH_change + i] = scratch[SCRATCH_way + i] = 0.0;
    make_list(i, position[i].xyz);
}
