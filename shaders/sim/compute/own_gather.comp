// The method's columns of remaining particles: drain_gather.comp.
#define OWN_ACCESS writeonly
#include "sim/constants.glsl"
#include "sim/own.glsl"
layout(std430, binding = MARKS_BUFFER) readonly buffer Before { uint before[]; };
layout(std430, binding = OLD_OWN_BUFFER) readonly buffer OldOwn { float old_own[]; };

void main()
{
    uint i = invocation();
    if (i >= particles_there() || before[i] == before[i + 1u])
        return;
    for (uint at = 0u; at < OWN_TOTAL * OWN_STRIDE; at += OWN_STRIDE)
        own[at + before[i]] = old_own[at + i];
}
