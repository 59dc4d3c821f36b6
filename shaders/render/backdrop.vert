// Sky and floor: a full-screen triangle or, with FLOOR_SHADOW, the part of the floor that the fluid may shade.
#include "common/frame.glsl"

// The view ray in the world: at the screen's corner, and a pixel's step in x and y. Not interpolated, so that both variants give
// the same colours to the bit.
layout(location = 0) flat out vec3 ray_corner;
layout(location = 1) flat out vec3 ray_x;
layout(location = 2) flat out vec3 ray_y;

void main()
{
    mat3 turn = mat3(eye_to_world);
    ray_corner = turn * ray_of_ndc(vec2(-1.0));
    ray_x = turn[0] * (2.0 * pixel_size.x * view_tangent.x);
    ray_y = turn[1] * (2.0 * pixel_size.y * view_tangent.y);
#ifdef FLOOR_SHADOW
    vec2 xz = floor_map_corner + floor_map_size * vec2(gl_VertexID & 1, gl_VertexID >> 1);
    vec3 at = (vec3(xz.x, floor_height, xz.y) - eye_to_world[3].xyz) * turn;
    gl_Position = clip_of_eye(at);
#else
    gl_Position = vec4(2.0 * vec2((gl_VertexID << 1) & 2, gl_VertexID & 2) - 1.0, 0.0, 1.0);
#endif
}
