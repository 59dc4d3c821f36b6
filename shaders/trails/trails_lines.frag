// What a piece of a trail leaves in the picture of all trails: time, scalar, depth and how much of the pixel it covers.
#include "shaders/shared/bindings.h"

layout(location = 0) noperspective in float across;
layout(location = 1) noperspective in vec2 stamp;
layout(location = HALF_WIDTH_AT) uniform float half_width; // pixels
layout(location = 0) out vec4 line;

void main()
{
    line = vec4(stamp, gl_FragCoord.z, clamp(half_width + 0.5 - abs(across), 0.0, 1.0));
}
