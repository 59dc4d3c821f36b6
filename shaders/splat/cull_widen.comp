// Maxima over the cells around, along one axis.
#include "common/frame.glsl"
#include "splat/cull.glsl"
#include "shaders/splat/splat_bindings.h"

layout(local_size_x = 64) in;
layout(location = UPWARDS_AT) uniform uint upwards; // 0: along x, 1: along y
layout(location = WIDEN_PART_AT) uniform uvec4 part; // of the map: column, row, columns, rows
layout(std430, binding = CULL_WIDENED_STORAGE) writeonly buffer Widened { uint widened[]; };

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= part.z * part.w)
        return;
    uvec2 at = part.xy + uvec2(i % part.z, i / part.z);
    uint cell = at.y * cell_count.x + at.x, along = upwards == 0u ? at.x : at.y, end = upwards == 0u ? cell_count.x : cell_count.y;
    uint stride = upwards == 0u ? 1u : cell_count.x, low = along - min(along, widen_reach), high = min(along + widen_reach, end - 1u);
    uint base = cell - along * stride, greatest = 0u;
    for (uint j = low; j <= high; j++)
        greatest = max(greatest, nearest[base + j * stride]);
    widened[cell] = greatest;
}
