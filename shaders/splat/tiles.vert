// Rectangles of tiles, at infinite distance (reversed depth 0): render/views/splat/splat_private.h.
#include "common/frame.glsl"
#include "shaders/splat/splat_bindings.h"
layout(std430, binding = TILE_RECTS_STORAGE) readonly buffer Rects { uvec4 rect[]; }; // x0 y0 x1 y1, pixels

void main()
{
    uint of = uint(gl_VertexID), corner = of % 6u;
    uvec4 own = rect[of / 6u];
    corner = corner < 3u ? corner : corner == 4u ? 1u : (corner + 1u) / 2u; // 0 1 2, 2 1 3
    uvec2 at = uvec2((corner & 1u) == 0u ? own.x : own.z, (corner & 2u) == 0u ? own.y : own.w);
    gl_Position = vec4(2.0 * vec2(at) * pixel_size - 1.0, 0.0, 1.0);
}
