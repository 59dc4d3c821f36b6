// The sides of a solid's block of voxels. The far sides are drawn: each pixel once, for any position of the eye.
#include "common/frame.glsl"
#include "shaders/volume/volume_bindings.h"

layout(location = SOLID_TO_EYE_AT) uniform mat4 solid_to_eye;
layout(location = SOLID_LOW_AT) uniform vec3 block_low; // m, the solid's frame
layout(location = SOLID_HIGH_AT) uniform vec3 block_high;

void main()
{
    const uint corners[6] = uint[](0u, 1u, 2u, 2u, 1u, 3u);
    uint side = uint(gl_VertexID) / 6u, axis = side >> 1, up = side & 1u, corner = corners[gl_VertexID % 6];
    vec3 at;
    at[axis] = float(up);
    at[(axis + 1u) % 3u] = float(up == 1u ? corner & 1u : corner >> 1);
    at[(axis + 2u) % 3u] = float(up == 1u ? corner >> 1 : corner & 1u);
    gl_Position = clip_of_eye((solid_to_eye * vec4(mix(block_low, block_high, at), 1.0)).xyz);
}
