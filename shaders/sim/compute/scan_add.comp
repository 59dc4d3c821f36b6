// Adds the total before each block of 1024.
#include "shaders/shared/scan.h"
layout(local_size_x = 256) in;
layout(std430, binding = SCAN_VALUES_STORAGE) buffer Values { uint value[]; };
layout(std430, binding = SCAN_TOTALS_STORAGE) readonly buffer Before { uint before[]; };
layout(location = SCAN_SIZE_AT) uniform uint size;

void main()
{
    uint block = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint base = block * 1024u + gl_LocalInvocationID.x * 4u;
    uint end = min(size, uint(value.length()));
    if (base >= end)
        return;
    uint more = before[block];
    for (uint k = 0u; k < 4u; k++)
        if (base + k < end)
            value[base + k] += more;
}
