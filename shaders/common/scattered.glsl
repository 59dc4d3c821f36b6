// The item of an invocation among `count` items, for minima and maxima by atomics: groups of 64 in a row, the groups in scattered
// order. In the particles' order, each particle may be nearer than all before and write; in random order, the n-th writes with
// probability 1 / n.
#include "shaders/shared/bindings.h"
layout(location = SCATTER_STEP_AT) uniform uint scatter_step; // coprime with the number of groups

uint scattered(uint count)
{
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x, groups = (count + 63u) / 64u;
    return group < groups ? group * scatter_step % groups * 64u + gl_LocalInvocationID.x : count;
}
