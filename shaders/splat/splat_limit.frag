// Between passes 1 and 2: writes the depth where blending ends, for an early test of whole sprites, and clears the sums.
#include "common/frame.glsl"
#include "shaders/splat/splat_bindings.h"

layout(binding = NEAREST_UNIT) uniform sampler2D nearest_map;
layout(location = EPS_AT) uniform float eps; // m
layout(location = 0) out vec4 color_sum;
layout(location = 1) out vec4 normal_sum;
layout(location = 2) out vec2 weight_sum;

void main()
{
    color_sum = normal_sum = vec4(0.0);
    weight_sum = vec2(0.0);
    gl_FragDepth = near_plane / (texelFetch(nearest_map, ivec2(gl_FragCoord.xy), 0).x + eps);
}
