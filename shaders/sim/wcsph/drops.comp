// wcsph with surface tension by curvature: each particle a body of its own; sim/methods/wcsph/drops.c.
#include "sim/constants.glsl"
#include "shaders/sim/term_block.h"
#include "sim/wcsph/drops.glsl"

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    drop[i] = i;
    for (uint k = DROP_TALLY; k < DROP_NUMBERS; k++)
        drop[drop_at(k, i)] = 0u;
}
