// A face of a brick (bricks_list.comp), four vertices each, counter-clockwise from outside.
#include "common/frame.glsl"
#include "volume/raycast.glsl"
#include "shaders/volume/volume_bindings.h"

layout(std430, binding = FACES_STORAGE) readonly buffer Faces { uint faces[]; };

void main()
{
    uint face = faces[gl_VertexID >> 2], side = face % 6u, number = face / 6u, axis = side >> 1, up = side & 1u;
    uvec3 count = uvec3(brick_count), corner = uvec3(number % count.x, number / count.x % count.y, number / (count.x * count.y));
    uvec2 across = uvec2(gl_VertexID & 1, (gl_VertexID >> 1) & 1);
    corner[axis] += up;
    corner[(axis + 1u) % 3u] += up == 1u ? across.x : across.y;
    corner[(axis + 2u) % 3u] += up == 1u ? across.y : across.x;
    vec3 in_eye = (volume_to_eye * vec4(brick_corner(corner), 1.0)).xyz;
    gl_Position = clip_of_eye(in_eye);
}
