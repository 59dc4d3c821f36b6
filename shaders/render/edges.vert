// The twelve edges of the box as lines of constant width on the screen: four vertices per edge.
#include "common/frame.glsl"

layout(location = 0) noperspective out float across;       // pixels from the line's middle
layout(location = 1) out vec3 place;                       // in the eye's frame
layout(location = 2) flat out vec3 normal;                 // normal of the bevel between the edge's two sides, towards the eye
layout(location = HALF_WIDTH_AT) uniform float half_width; // pixels

layout(location = EDGES_BEHIND_AT) uniform uint behind; // 1: only edges between sides that both face away from the eye

// Corners are numbered by bits: x, y, z; edge e runs along axis e / 4.
vec3 corner_of_edge(int edge, int end)
{
    int axis = edge >> 2, side = edge & 3;
    ivec3 bits;
    bits[axis] = end;
    bits[(axis + 1) % 3] = side & 1;
    bits[(axis + 2) % 3] = side >> 1;
    return (vec3(bits) - vec3(0.5, 0.0, 0.5)) * box_size;
}

// True if one of the edge's two sides faces the eye.
bool faces_eye(int edge)
{
    vec3 eye = -box_to_eye[3].xyz * mat3(box_to_eye), corner = corner_of_edge(edge, 0); // transposed rotations are inverses
    vec3 out_of = sign(corner - vec3(0.0, 0.5, 0.0) * box_size) * (eye - corner);
    int axis = edge >> 2;
    return out_of[(axis + 1) % 3] > 0.0 || out_of[(axis + 2) % 3] > 0.0;
}

// The bevel's normal in the eye's frame: between the normals of the two sides. From inside, through the glass, the other face is
// visible.
vec3 bevel(int edge, vec3 at)
{
    vec3 outward = sign(corner_of_edge(edge, 0) - vec3(0.0, 0.5, 0.0) * box_size);
    outward[edge >> 2] = 0.0;
    vec3 turned = mat3(box_to_eye) * normalize(outward);
    return dot(turned, at) > 0.0 ? -turned : turned;
}

// The end of the edge, moved along the edge to in front of the eye.
vec3 in_front(vec3 a, vec3 b)
{
    float clear = -2.0 * near_plane;
    return a.z <= clear ? a : b.z >= clear ? a : mix(a, b, (a.z - clear) / (a.z - b.z));
}

void main()
{
    int edge = gl_VertexID >> 2, end = gl_VertexID & 1;
    vec3 a = (box_to_eye * vec4(corner_of_edge(edge, end), 1.0)).xyz;
    vec3 b = (box_to_eye * vec4(corner_of_edge(edge, 1 - end), 1.0)).xyz;
    vec3 from = in_front(a, b), to = in_front(b, a);
    if (max(from.z, to.z) > -near_plane || (behind != 0u && faces_eye(edge))) {
        gl_Position = vec4(2.0, 2.0, 0.0, 1.0);
        place = normal = vec3(0.0);
        across = 0.0;
        return;
    }
    place = from;
    normal = bevel(edge, from);
    vec2 here = ndc_of_eye(from), there = ndc_of_eye(to);
    vec2 along = (there - here) * picture_size;
    vec2 normal = vec2(-along.y, along.x) / max(length(along), 1e-6) * (end == 0 ? 1.0 : -1.0);
    across = ((gl_VertexID & 2) == 0 ? -1.0 : 1.0) * (half_width + 1.0);
    vec2 shift = normal * across * 2.0 * pixel_size;
    // A little nearer than the true depth: fluid at a wall is as near as the wall's edges, and is drawn first.
    gl_Position = vec4((here + shift) * -from.z, 1.003 * near_plane, -from.z);
}
