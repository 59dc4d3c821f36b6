// Maxima over the cells around, along one axis.
#include "common/frame.glsl"
#include "splat/cull.glsl"
#include "shaders/splat/splat_bindings.h"

layout(local_size_x = 64) in;
layout(location = UPWARDS_AT) uniform uint upwards; // 0: along x, 1: along y
layout(std430, binding = CULL_WIDENED_STORAGE) writeonly buffer Widened { uint widened[]; };

void main()
{
    uint cell = gl_GlobalInvocationID.x;
    if (cell >= cell_count.x * cell_count.y)
        return;
    uint along = upwards == 0u ? cell % cell_count.x : cell / cell_count.x, end = upwards == 0u ? cell_count.x : cell_count.y;
    uint stride = upwards == 0u ? 1u : cell_count.x, low = along - min(along, widen_reach), high = min(along + widen_reach, end - 1u);
    uint base = cell - along * stride, greatest = 0u;
    for (uint i = low; i <= high; i++)
        greatest = max(greatest, nearest[base + i * stride]);
    widened[cell] = greatest;
}
