// dfsph: accelerations except pressure, by friction and surface tension: others_body in sim/methods/dfsph/dfsph_passes.c.
#define LISTS_LATER
#include "sim/constants.glsl"
#include "shaders/sim/dfsph/dfsph_block.h"
#include "sim/incompressible/friction.glsl"

float volume_of(uint i) { return velocity[i].w; }

#ifdef FELT_SOLIDS
#include "sim/felt_solids.glsl"
#else
void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    acceleration[i] = vec4(other_forces(i) / fluids[FLUID_OF(i)].mass, 0.0);
}
#endif
