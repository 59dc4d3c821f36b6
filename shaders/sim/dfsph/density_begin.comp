// dfsph: the solver of density begins with k = 0: density_begin in sim/methods/dfsph/dfsph_passes.c.
#include "sim/constants.glsl"
#include "shaders/sim/dfsph/dfsph_block.h"
#include "sim/scratch.glsl"
#include "sim/dfsph/flown.glsl"
layout(std430, binding = NEAR_BUFFER) buffer Near { vec4 near[]; };                          // w: k
layout(std430, binding = VELOCITIES_BUFFER) readonly buffer Velocities { vec4 velocity[]; }; // w: volume
layout(std430, binding = PUSHES_BUFFER) writeonly buffer Pushes { vec4 push[]; };            // accelerations, k
layout(std430, binding = MOVES_BUFFER) writeonly buffer Moves { vec4 move[]; };              // velocities, volume
layout(location = PASS_DT_AT) uniform float dt;

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    near[i].w = 0.0;
    push[i] = vec4(0);
    move[i] = vec4(flown(velocity[i].xyz, near[i].xyz, vec3(0), dt), velocity[i].w);
    scratch[SCRATCH_change + i] = 0.0;
}
