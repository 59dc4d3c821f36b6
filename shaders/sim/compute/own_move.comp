// Moves the method's columns like their particles: move.comp.
#define OWN_ACCESS writeonly
#include "sim/constants.glsl"
#include "sim/own.glsl"
layout(std430, binding = ORDERS_BUFFER) readonly buffer Orders { uint order[]; };
layout(std430, binding = OLD_OWN_BUFFER) readonly buffer OldOwn { float old_own[]; };

void main()
{
    uint i = invocation();
    if (i >= particles_there())
        return;
    uint o = particle_count() > 0u ? order[i] : i;
    for (uint at = 0u; at < OWN_TOTAL * OWN_STRIDE; at += OWN_STRIDE)
        own[at + i] = old_own[at + o];
}
