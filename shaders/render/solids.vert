#include "common/frame.glsl"
#include "shaders/shared/solid_block.h"

layout(location = 0) in vec3 position; // in the solid's own frame, m
layout(location = 1) in vec3 normal;
layout(location = 2) in uint solid;
layout(location = 0) out vec3 in_eye;
layout(location = 1) out vec3 normal_in_eye;
layout(location = 2) out vec3 in_box;
layout(location = 3) flat out uint number;

void main()
{
    mat4 to_eye = solids[solid].to_eye;
    in_eye = (to_eye * vec4(position, 1.0)).xyz;
    normal_in_eye = mat3(to_eye) * normal;
    in_box = (solids[solid].to_box * vec4(position, 1.0)).xyz;
    number = solid;
    gl_Position = clip_of_eye(in_eye);
}
