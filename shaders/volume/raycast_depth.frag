// What rays met, into the target's depth.
#include "common/frame.glsl"

layout(binding = 1) uniform sampler2D found_map;

void main()
{
    float t = texelFetch(found_map, ivec2(gl_FragCoord.xy), 0).x;
    if (t <= 0.0)
        discard;
    gl_FragDepth = near_plane / t;
}
