// Blends each pixel beside an outline of a finished picture with the pixels across. DISCS and ROWS: see
// render/views/splat/splat_private.h.
#include "common/frame.glsl"
#include "common/encoded.glsl"
#include "splat/silhouette.glsl"
#include "shaders/splat/splat_bindings.h"

layout(binding = PICTURE_UNIT) uniform sampler2D picture;
layout(binding = EDGES_UNIT) uniform sampler2D edge_map;
layout(location = 0) out vec4 color; // sRGB

vec3 color_of(ivec2 pixel)
{
    return texelFetch(picture, pixel, 0).rgb;
}

#ifdef DISCS
#include "splat/silhouette_discs.glsl"
#endif
#ifdef ROWS
#include "splat/silhouette_rows.glsl"
#endif

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 sides = texelFetch(edge_map, pixel, 0);
    vec3 mixed = color_of(pixel);
#ifdef DISCS
    if (any(greaterThan(sides, vec4(0.75))))
        mixed = mixed_by_discs(pixel, mixed, sides);
    sides *= 1.0 - step(0.75, sides);
#endif
#ifdef ROWS
    if (sides != vec4(0.0))
        mixed = mixed_by_rows(pixel, mixed, sides);
#endif
    color = vec4(encoded(mixed), 1.0);
}
