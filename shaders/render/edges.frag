#include "common/frame.glsl"

layout(location = 0) noperspective in float across;
layout(location = HALF_WIDTH_AT) uniform float half_width;
layout(location = 0) out vec4 color;

void main()
{
    color = vec4(edge_color.rgb, edge_color.a * clamp(half_width + 0.5 - abs(across), 0.0, 1.0));
}
