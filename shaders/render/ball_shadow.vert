// Particles as the light sees them: squares of the disc's area at the depth of the centre, which the blur and the bilinear
// texel round off. No discard and no depth written by the fragment, so that the driver's fast path does it.
#include "common/frame.glsl"
#include "common/particles.glsl"
#include "common/listed.glsl"
#include "common/ball.glsl"
#include "shaders/shared/shadow_maps.h"

void main()
{
    Ball ball = ball_of(listed_particle(uint(gl_VertexID)));
    vec3 at = (box_to_light * vec4(ball.centre, 1.0)).xyz;
    gl_Position = vec4(2.0 * at.xy - 1.0, at.z, 1.0);
    gl_PointSize = 1.77245 * shadow_radius * (ball.radius / particle_radius) / light_depth * float(SHADOW_MAP_TEXELS); // the map is light_depth wide
}
