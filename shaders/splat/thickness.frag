// A particle's share of the fluid's thickness, render/splat/thickness.h: its field along the whole ray, where its centre is before the
// solid.
#include "common/frame.glsl"
#include "common/sphere.glsl"
#include "splat/splat.glsl"
#include "splat/splat_at.glsl"

#ifdef SOLIDS
layout(binding = 1) uniform sampler2D solid_depth; // the target's, reversed
layout(location = 2) uniform vec2 texels;
layout(location = 3) uniform ivec2 pixels;
#endif
layout(location = 2) flat in vec2 column; // along the ray through the centre, m; the centre's reversed depth
layout(location = 0) out float thickness;

void main()
{
    float inside2 = max(splat_here().inside2, 0.0);
#ifdef SOLIDS
    ivec2 pixel = ivec2(gl_FragCoord.xy / texels * vec2(pixels));
    if (texelFetch(solid_depth, min(pixel, pixels - 1), 0).x > column.y)
        discard;
#endif
    thickness = column.x * inside2 * inside2 * inside2 * sqrt(inside2);
}
