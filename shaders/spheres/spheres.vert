// Four vertices per particle: the corners of its bound on the screen. A solver's particles are in the order of its cells, along z
// last: drawn from their nearer end, hidden ones fail the early depth test.
#include "common/frame.glsl"
#include "common/particles.glsl"
#include "common/sphere.glsl"
#include "common/ball.glsl"
#include "shaders/spheres/spheres_bindings.h"
#ifdef VEILED
#include "common/particle_veils.glsl"
layout(location = 3) flat out vec2 door;
#endif

layout(location = LAST_AT) uniform uint last;

layout(location = 0) noperspective out vec3 offset;
layout(location = 1) flat out vec3 constants;
layout(location = 2) flat out uint index;

void main()
{
    index = uint(gl_VertexID) >> 2;
    if (box_to_eye[2].z > 0.0)
        index = last - index;
    Ball ball = ball_of(index);
    vec3 centre = (box_to_eye * vec4(ball.centre, 1.0)).xyz;
    Sphere sphere = sphere_at(centre, ball.radius);
    vec4 bounds = sphere_bounds(sphere);
#ifdef DROPS
    if (ball.radius <= 0.0)
        bounds = vec4(0.0);
#endif
#ifdef VEILED
    door = veil[index];
#endif
    vec2 corner = vec2((gl_VertexID & 1) == 0 ? bounds.x : bounds.y, (gl_VertexID & 2) == 0 ? bounds.z : bounds.w);
    offset = sphere_offset(sphere, ray_of_ndc(corner));
    constants = sphere_constants(sphere);
    // No point of the sphere is nearer: hardware leaves out hidden pixels before it shades them (depth_less).
    float nearest = near_plane / max(-centre.z - ball.radius, near_plane);
    gl_Position = vec4(corner, min(nearest * 1.00001, 1.0), 1.0);
}
