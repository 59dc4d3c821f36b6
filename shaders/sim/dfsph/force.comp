// dfsph: accelerations but those of pressure, by friction and surface tension: others_body in sim/dfsph/passes.c.
#define LISTS_LATER
#include "sim/constants.glsl"
#include "shaders/sim/dfsph/dfsph_block.h"
#include "sim/incompressible/friction.glsl"

float volume_of(uint i) { return velocity[i].w; }

#ifdef FELT_SOLIDS
#include "sim/felt_solids.glsl"
#else
#include "sim/wall_cushion.glsl"
layout(location = PASS_DT_AT) uniform float dt;

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    vec3 x = near[i].xyz;
    acceleration[i] = vec4(other_forces(i) / fluids[FLUID_OF(i)].mass + cushion_at(x, felt_at(x), dt), 0.0);
}
#endif
