// Combines the parts of 64 lanes into one, always in the same order.
#include "render/probe.glsl"
layout(local_size_x = 64) in;
shared Part lanes[64];

// The result is for lane 0.
Part folded(Part own)
{
    uint lane = gl_LocalInvocationID.x;
    lanes[lane] = own;
    for (uint half_way = 32u; half_way > 0u; half_way /= 2u) {
        barrier();
        if (lane < half_way)
            lanes[lane] = together(lanes[lane], lanes[lane + half_way]);
    }
    return lanes[0];
}
