// Writes only the surface's depth, where splat_shade.frag will shade.
#include "common/frame.glsl"
#include "common/nan.glsl"
#include "shaders/splat/splat_bindings.h"

layout(binding = NEAREST_UNIT) uniform sampler2D nearest_map;
layout(binding = NORMAL_SUM_UNIT) uniform sampler2D normal_map;
layout(binding = WEIGHT_SUM_UNIT) uniform sampler2D weight_map;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(nearest_map, pixel, 0).x, weight = texelFetch(weight_map, pixel, 0).x;
    vec3 normal = texelFetch(normal_map, pixel, 0).xyz;
    float length2 = dot(normal, normal);
    if (is_nan(length2) || depth >= 1e29 || weight <= 0.0 || length2 <= 0.0)
        discard;
    gl_FragDepth = near_plane / abs(depth); // negative at a wall
}
