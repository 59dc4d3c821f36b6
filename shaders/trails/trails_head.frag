// The newest piece of a trail, until the next state replaces the piece.
#include "shaders/trails/trails_color.glsl"
#include "shaders/trails/trails_covered.glsl"

layout(location = 0) noperspective in float across;
layout(location = 1) noperspective in vec2 stamp;
layout(location = 0) out vec4 color;

void main()
{
    color = trail_color(stamp.x, stamp.y, covered_of(across));
}
