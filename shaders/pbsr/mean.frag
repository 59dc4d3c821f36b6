// The mean of all sets over the background: alpha is the fraction of sets with a point in the pixel. Two passes: first the part
// behind overlays and edges, from the sets without a point in front; then the part in front, with the nearest depth.
#include "shaders/pbsr/pbsr_bindings.h"
layout(binding = SETS_SUM_UNIT) uniform sampler2D front_map;
layout(binding = SETS_OVER_UNIT) uniform sampler2D back_map;
layout(binding = SETS_NEAR_UNIT) uniform sampler2D near_map;
layout(location = SETS_COUNT_AT) uniform float sets;
layout(location = SETS_SIDE_AT) uniform uint side;
layout(location = 0) out vec4 color;

void main()
{
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec4 front = texelFetch(front_map, at, 0), back = side == SETS_BACK ? texelFetch(back_map, at, 0) : vec4(0.0);
    vec4 shown = side == SETS_BACK ? back : front;
    if (shown.a <= 0.0)
        discard;
    color = shown / (side == SETS_BACK ? sets - front.a : sets);
    gl_FragDepth = texelFetch(near_map, at, 0).x;
}
