// The triangles of a listed cube (mesh_list.comp), 15 vertices each: vertices without a triangle are outside the picture. After: W.
// Lorensen, H. Cline, "Marching cubes", 1987, with the cases of the exported mesh (sim/mesh.h).
#include "common/frame.glsl"
#include "volume/mesh.glsl"

layout(std430, binding = MESH_CUBES_STORAGE) readonly buffer Cubes { uvec2 cubes[]; };
layout(std430, binding = MESH_CASES_STORAGE) readonly buffer Cases { uvec4 cases[]; }; // 15 edges in bytes, number of triangles

layout(location = 0) out vec3 in_eye;
layout(location = 1) out vec3 corner_share;

uint case_byte(int inside, int number)
{
    return cases[inside][number >> 2] >> (8 * (number & 3)) & 255u;
}

// Where the level is between two nodes: linear, and a little away from both, as in the exported mesh.
float crossing(float from, float to)
{
    float t = (surface_level - from) / (to - from);
    return t > 0.001 ? min(t, 0.999) : 0.001;
}

void main()
{
    gl_Position = vec4(2.0, 2.0, 0.5, 1.0);
    in_eye = corner_share = vec3(0.0);
    if (gl_VertexID / 15 >= cubes.length())
        return;
    uvec2 cube = cubes[gl_VertexID / 15];
    int number = gl_VertexID % 15, inside = int(cube.y >> 16);
    if (number >= 3 * int(case_byte(inside, 15)))
        return;
    int edge = int(case_byte(inside, number)), axis = edge >> 2;
    ivec3 from = ivec3(cube.x & 65535u, cube.x >> 16, cube.y & 65535u) - 1, to;
    from[(axis + 1) % 3] += edge & 1;
    from[(axis + 2) % 3] += edge >> 1 & 1;
    to = from;
    to[axis]++;
    vec3 at = mix(node_place(from), node_place(to), crossing(node_value(from), node_value(to)));
    in_eye = (volume_to_eye * vec4(at, 1.0)).xyz;
    corner_share[number % 3] = 1.0;
    gl_Position = clip_of_eye(in_eye);
}
