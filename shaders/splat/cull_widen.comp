// Maxima over the cells around, along one axis.
#include "common/frame.glsl"
#include "splat/cull.glsl"

layout(local_size_x = 64) in;
layout(location = 3) uniform uint upwards; // 0: along x, 1: along y
layout(std430, binding = 5) writeonly buffer Widened { uint widened[]; };

void main()
{
    uint cell = gl_GlobalInvocationID.x;
    if (cell >= grid.x * grid.y)
        return;
    uint along = upwards == 0u ? cell % grid.x : cell / grid.x, end = upwards == 0u ? grid.x : grid.y;
    uint stride = upwards == 0u ? 1u : grid.x, low = along - min(along, grid.w), high = min(along + grid.w, end - 1u);
    uint base = cell - along * stride, greatest = 0u;
    for (uint i = low; i <= high; i++)
        greatest = max(greatest, nearest[base + i * stride]);
    widened[cell] = greatest;
}
