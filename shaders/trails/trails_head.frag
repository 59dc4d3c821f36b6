// The newest piece of a trail, which the next state replaces.
#include "shaders/trails/trails_color.glsl"

layout(location = 0) noperspective in float across;
layout(location = 1) noperspective in vec2 stamp;
layout(location = HALF_WIDTH_AT) uniform float half_width; // pixels
layout(location = 0) out vec4 color;

void main()
{
    color = trail_color(stamp.x, stamp.y, clamp(half_width + 0.5 - abs(across), 0.0, 1.0));
}
