// The slice's rectangle, in space or filling the viewport.
#include "common/frame.glsl"
#include "shaders/shared/plane_block.h"
#include "shaders/slice/slice_bindings.h"

layout(location = FLAT_AT) uniform uint is_flat;
layout(location = 0) out vec2 share; // position in the rectangle, 0 .. 1

void main()
{
    share = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    dvec2 squares = dvec2(share * plane_samples * plane_side * plane_side); // the axes have the length 1 / side
    vec3 at = (box_to_eye * vec4(plane_corner + squares.x * plane_along + squares.y * plane_up, 1.0)).xyz;
    gl_Position = is_flat != 0u ? vec4(share * 2.0 - 1.0, 0.5, 1.0) : clip_of_eye(at);
}
