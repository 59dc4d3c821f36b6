// Draws the picture of all trails, drawn by the CPU, over the view's picture, by depth.
#include "shaders/trails/trails_color.glsl"

layout(binding = TRAIL_LINES_UNIT) uniform samplerBuffer lines; // rows from the bottom up
layout(location = 0) out vec4 color;

void main()
{
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec4 line = texelFetch(lines, at.y * int(picture_size.x + 0.5) + at.x);
    color = trail_color(line.x, line.y, line.w);
    if (color.a <= 0.0)
        discard;
    gl_FragDepth = line.z;
}
