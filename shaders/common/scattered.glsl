// Which of `count` an invocation takes, for minima and maxima by atomics: groups of 64 in a row, the groups not in order. In the
// particles' order each may be nearer than all before, and write; of a random order the n-th is with a chance of 1 / n.
#include "shaders/shared/bindings.h"
layout(location = SCATTER_STEP_AT) uniform uint scatter_step; // has no divisor in common with the number of groups

uint scattered(uint count)
{
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x, groups = (count + 63u) / 64u;
    return group < groups ? group * scatter_step % groups * 64u + gl_LocalInvocationID.x : count;
}
