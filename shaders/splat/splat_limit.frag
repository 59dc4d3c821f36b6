// Between pass 1 and 2: the depth at which blending ends, for an early test of whole sprites.
#include "common/frame.glsl"
#include "shaders/splat/splat_bindings.h"

layout(binding = NEAREST_UNIT) uniform sampler2D nearest_map;
layout(location = EPS_AT) uniform float eps; // m

void main()
{
    gl_FragDepth = near_plane / (texelFetch(nearest_map, ivec2(gl_FragCoord.xy), 0).x + eps);
}
