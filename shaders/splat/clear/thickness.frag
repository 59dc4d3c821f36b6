// A particle's contribution to the fluid's thickness, render/views/splat/splat_private.h: its field along the whole ray, if the centre is
// in front of the solid.
#include "common/frame.glsl"
#include "common/sphere.glsl"
#include "splat/splat.glsl"
#include "splat/splat_at.glsl"
#include "shaders/splat/splat_bindings.h"

#ifdef SOLIDS
layout(binding = TARGET_DEPTH_UNIT) uniform sampler2D solid_depth; // the target's, reversed
layout(location = MAP_SIZE_AT) uniform vec2 texels;
#endif
layout(location = 2) flat in vec2 column; // integral along the ray through the centre, m; the centre's reversed depth
layout(location = 0) out float thickness;

void main()
{
    float inside2 = max(splat_here().inside2, 0.0);
#ifdef SOLIDS
    ivec2 pixel = ivec2(gl_FragCoord.xy / texels * picture_size);
    if (texelFetch(solid_depth, min(pixel, ivec2(picture_size) - 1), 0).x > column.y)
        discard;
#endif
    thickness = column.x * inside2 * inside2 * inside2 * sqrt(inside2);
}
