// The parts of the picture with trails: render/overlays/trails/trails_private.h.
#include "common/frame.glsl"
#include "shaders/trails/trails_bindings.h"
layout(std430, binding = TRAIL_BLOCKS_STORAGE) readonly buffer Blocks { uint blocks[]; }; // row, first and end: 10 bits each

void main()
{
    uint of = uint(gl_VertexID), corner = of % 6u, own = blocks[of / 6u];
    corner = corner < 3u ? corner : corner == 4u ? 1u : (corner + 1u) / 2u; // 0 1 2, 2 1 3
    uint row = own & 1023u, first = own >> 10u & 1023u, end = own >> 20u;
    uvec2 at = uvec2((corner & 1u) == 0u ? first : end, row + (corner >> 1u)) * TRAIL_BLOCK_SIDE;
    gl_Position = vec4(2.0 * vec2(at) * pixel_size - 1.0, 0.0, 1.0);
}
