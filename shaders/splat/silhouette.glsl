// Visible surfaces in a finished picture of the view splat, for render/views/splat/splat_shade.c. Needs common/frame.glsl.
#include "shaders/splat/splat_bindings.h"
layout(binding = NEAREST_UNIT) uniform sampler2D nearest_map;
layout(binding = TARGET_DEPTH_UNIT) uniform sampler2D target_depth;
layout(binding = WEIGHT_SUM_UNIT) uniform sampler2D weight_map;
layout(location = LEAST_STEP_AT) uniform float least; // m: smaller depth steps do not separate surfaces

struct Seen {
    float depth; // m; 1e30 without fluid or solid
    bool fluid;
};

// Pixels outside the picture are clamped to the border.
Seen seen_at(ivec2 pixel)
{
    pixel = clamp(pixel, ivec2(0), ivec2(picture_size) - 1);
    float z = abs(texelFetch(nearest_map, pixel, 0).x); // negative at a wall
#ifdef SOLIDS
    float nearness = texelFetch(target_depth, pixel, 0).x;
    if (nearness > near_plane / z * 1.00001)
        return Seen(near_plane / nearness, false);
#endif
    return Seen(z, z < 1e29);
}
