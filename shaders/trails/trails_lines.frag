// A piece's output in the picture of all trails: time, scalar, depth and covered fraction.
#include "shaders/trails/trails_covered.glsl"

layout(location = 0) noperspective in float across;
layout(location = 1) noperspective in vec2 stamp;
layout(location = 0) out vec4 line;

void main()
{
    line = vec4(stamp, gl_FragCoord.z, covered_of(across));
}
