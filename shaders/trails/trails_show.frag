// Draws the picture of all trails over the view's picture, by depth.
#include "shaders/trails/trails_color.glsl"

layout(binding = TRAIL_LINES_UNIT) uniform sampler2D lines;
layout(location = 0) out vec4 color;

void main()
{
    vec4 line = texelFetch(lines, ivec2(gl_FragCoord.xy), 0);
    color = trail_color(line.x, line.y, line.w);
    if (color.a <= 0.0)
        discard;
    gl_FragDepth = line.z;
}
