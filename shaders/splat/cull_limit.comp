// The coarse map from a depth map behind which nothing is needed: the farthest pixel of each cell.
#include "common/frame.glsl"
#include "splat/cull.glsl"
#include "shaders/splat/splat_bindings.h"

layout(local_size_x = 64) in;
layout(binding = LIMIT_UNIT) uniform sampler2D limit_map; // reversed depth

void main()
{
    uint cell = gl_GlobalInvocationID.x;
    if (cell >= cell_count.x * cell_count.y)
        return;
    uvec2 at = uvec2(cell % cell_count.x, cell / cell_count.x);
    ivec2 low = ivec2(at) * int(cell_side), high = min(low + int(cell_side), ivec2(cull_pixels));
    float least = 1.0;
    for (int y = low.y; y < high.y; y++)
        for (int x = low.x; x < high.x; x++)
            least = min(least, texelFetch(limit_map, ivec2(x, y), 0).x);
    nearest[cell_at(at.x, at.y)] = least > 0.0 ? floatBitsToUint(near_plane / least) : nothing;
}
