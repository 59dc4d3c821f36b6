// Finds the particles that may be visible, and the picture's tiles that their sprites touch. Per 32 particles: a word of bits and
// a number for the visible list, and for the blend list (splat/cull_kept.glsl).
#include "common/frame.glsl"
#include "common/particles.glsl"
#include "common/ball.glsl"
#include "splat/cull.glsl"
#include "splat/cull_kept.glsl"
#include "common/sphere.glsl"
#include "splat/splat_body.glsl"
#include "shaders/splat/splat_bindings.h"

layout(local_size_x = 64) in;
layout(location = CULL_COUNT_AT) uniform uint count;
layout(location = EPS_AT) uniform float eps; // m
layout(location = INVERT_AT) uniform uint invert; // 1: list the hidden particles instead
layout(std430, binding = CULL_KEPT_STORAGE) writeonly buffer Kept { uint kept[]; };
layout(std430, binding = TILE_MARKS_STORAGE) writeonly buffer Marks { uint tile_mark[]; }; // splat/tiles_list.comp

// x0 x1 y0 y1 of the sprite, pixels; `depth`: nearest depth.
vec4 sprite_of(uint index, out float depth)
{
    Body body = body_of(index);
    depth = body_nearest(body);
    return (body_bounds(body) * 0.5 + 0.5) * cull_pixels.xxyy;
}

void mark_tiles(vec4 sprite)
{
    uvec2 tiles = (uvec2(cull_pixels) + uint(TILE - 1)) / TILE;
    vec4 wide = sprite + float(TILE_MARGIN) * vec4(-1.0, 1.0, -1.0, 1.0);
    uvec4 touched = uvec4(clamp(wide / TILE, vec4(0.0), vec4(tiles.xxyy) - 1.0));
    for (uint y = touched.z; y <= touched.w; y++)
        for (uint x = touched.x; x <= touched.y; x++)
            tile_mark[y * tiles.x + x] = 1u;
}

const uint HIDDEN = 4u, MOST_CELLS = 12u; // largest number of cells along a side of a sprite that are tested

// Bit 0: may be the nearest somewhere; bit 1: may blend; or HIDDEN. 0 for particles outside the picture, and for NaN.
uint seen(vec4 sprite, float depth)
{
    if (is_nan(sprite) || sprite.x >= sprite.y || sprite.z >= sprite.w)
        return 0u;
    uvec4 cells = uvec4(clamp(floor(sprite / float(cell_side)), vec4(0.0), vec4(cell_count.xxyy) - 1.0));
    if (max(cells.y - cells.x, cells.w - cells.z) > MOST_CELLS)
        return 3u;
    float behind = uintBitsToFloat(greatest_in(cells, floatBitsToUint(max(depth, 0.0))));
    if (depth > (behind + eps) * 1.00001)
        return HIDDEN;
    return depth <= behind * 1.00001 ? 3u : 2u;
}

void main()
{
    uint chunk = gl_GlobalInvocationID.x, first = chunk * 32u;
    if (first >= count)
        return;
    uvec2 bits = uvec2(0u);
    for (uint i = 0u; i < min(32u, count - first); i++) {
        float depth;
        vec4 sprite = sprite_of(first + i, depth);
        uint what = seen(sprite, depth);
        if (invert != 0u)
            what = what == HIDDEN ? 3u : 0u;
        if ((what & 3u) != 0u)
            mark_tiles(sprite);
        bits |= uvec2(what & 1u, what >> 1 & 1u) << i;
    }
    uint chunks = (count + 31u) / 32u;
    for (uint k = 0u; k < 2u; k++) {
        kept[KEPT_NUMBER(k) + chunk] = uint(bitCount(bits[k]));
        kept[KEPT_BITS(k) + chunk] = bits[k];
    }
}
