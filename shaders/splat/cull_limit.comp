// The coarse map from a depth map behind which nothing is wanted: the farthest of each cell's pixels.
#include "common/frame.glsl"
#include "splat/cull.glsl"

layout(local_size_x = 64) in;
layout(binding = 7) uniform sampler2D limit_map; // reversed depth

void main()
{
    uint cell = gl_GlobalInvocationID.x;
    if (cell >= grid.x * grid.y)
        return;
    ivec2 low = ivec2(cell % grid.x, cell / grid.x) * int(grid.z), high = min(low + int(grid.z), ivec2(projection.xy));
    float least = 1.0;
    for (int y = low.y; y < high.y; y++)
        for (int x = low.x; x < high.x; x++)
            least = min(least, texelFetch(limit_map, ivec2(x, y), 0).x);
    nearest[cell] = least > 0.0 ? floatBitsToUint(near_plane / least) : nothing;
}
