// The six sides of the box as panes: the sides that face the eye, or with `behind` the sides that face away.
#include "common/frame.glsl"

layout(location = 0) out vec3 place;       // in the eye's frame
layout(location = 1) flat out vec3 normal; // towards the eye
layout(location = EDGES_BEHIND_AT) uniform uint behind;

void main()
{
    int side = gl_VertexID / 6, corner = gl_VertexID % 6, axis = side >> 1;
    corner = corner < 3 ? corner : 6 - corner; // 0 1 2, 3 2 1
    vec3 at, outward = vec3(0.0);
    outward[axis] = (side & 1) == 0 ? -1.0 : 1.0;
    at[axis] = 0.5 * outward[axis];
    at[(axis + 1) % 3] = float(corner & 1) - 0.5;
    at[(axis + 2) % 3] = float(corner >> 1) - 0.5;
    place = (box_to_eye * vec4((at + vec3(0.0, 0.5, 0.0)) * box_size, 1.0)).xyz;
    normal = mat3(box_to_eye) * outward;
    vec3 middle = (box_to_eye * vec4((0.5 * outward + vec3(0.0, 0.5, 0.0)) * box_size, 1.0)).xyz;
    bool away = dot(normal, middle) > 0.0; // equal for all corners, even if the eye is in the pane's plane
    normal = away ? -normal : normal;
    gl_Position = away == (behind != 0u) ? vec4(clip_of_eye(place).xy, 1.002 * near_plane, -place.z) : vec4(2.0, 2.0, 0.0, 1.0);
}
