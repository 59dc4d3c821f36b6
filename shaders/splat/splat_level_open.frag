// Prepares a sum: clears it and lets through the spheres that start before the end of the range, in pixels still searching, or
// with FOUND in pixels with a root.
#include "common/frame.glsl"
#include "shaders/splat/splat_bindings.h"

layout(binding = NEAREST_UNIT) uniform sampler2D start_map;
layout(binding = MARCH_UNIT) uniform sampler2D march_map;
layout(location = SEARCH_RANGE_AT) uniform float range; // m
layout(location = 0) out vec4 value_sum;
#ifndef FOUND
layout(location = 1) out vec4 slope_sum;
#endif

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float start = texelFetch(start_map, pixel, 0).x;
    bool found = texelFetch(march_map, pixel, 0).w > 0.0;
    value_sum = vec4(0.0);
#ifdef FOUND
    bool open = found;
#else
    bool open = !found && start < 1e29;
    slope_sum = vec4(0.0);
#endif
    gl_FragDepth = open ? near_plane / (start + range) : 1.0; // nothing is before the near plane
}
