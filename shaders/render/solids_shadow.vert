// Solids seen from the light.
#include "shaders/shared/solid_block.h"

layout(location = 0) in vec3 position; // in the solid's own frame, m
layout(location = 2) in uint solid;
layout(location = 0) out vec3 in_box;
layout(location = 1) flat out uint number;

void main()
{
    vec3 at = (solids[solid].to_light * vec4(position, 1.0)).xyz;
    in_box = (solids[solid].to_box * vec4(position, 1.0)).xyz;
    number = solid;
    gl_Position = vec4(2.0 * at.xy - 1.0, at.z, 1.0);
}
