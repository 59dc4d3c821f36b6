// Exclusive prefix sums of blocks of 1024, in place; each block's total goes into `total`.
#include "shaders/shared/scan.h"
layout(local_size_x = 256) in;
layout(std430, binding = SCAN_VALUES_STORAGE) buffer Values { uint value[]; };
layout(std430, binding = SCAN_TOTALS_STORAGE) writeonly buffer Totals { uint total[]; };
layout(location = SCAN_SIZE_AT) uniform uint size;
shared uint part[256];

void main()
{
    uint block = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    uint lane = gl_LocalInvocationID.x, base = block * 1024u + lane * 4u, end = min(size, uint(value.length()));
    uint own[4], sum = 0u;
    for (uint k = 0u; k < 4u; k++) {
        own[k] = base + k < end ? value[base + k] : 0u;
        sum += own[k];
    }
    part[lane] = sum;
    barrier();
    for (uint reach = 1u; reach < 256u; reach *= 2u) { // Hillis and Steele 1986
        uint before = lane >= reach ? part[lane - reach] : 0u;
        barrier();
        part[lane] += before;
        barrier();
    }
    uint running = part[lane] - sum;
    for (uint k = 0u; k < 4u; k++) {
        if (base + k < end)
            value[base + k] = running;
        running += own[k];
    }
    if (lane == 255u && block * 1024u < end && block < uint(total.length()))
        total[block] = part[255];
}
