// Writes the rays' hits into the target's depth.
#include "common/frame.glsl"
#include "shaders/volume/volume_bindings.h"

layout(binding = FOUND_UNIT) uniform sampler2D found_map;

void main()
{
    float t = texelFetch(found_map, ivec2(gl_FragCoord.xy), 0).x;
    if (t <= 0.0)
        discard;
    gl_FragDepth = near_plane / t;
}
