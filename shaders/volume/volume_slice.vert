// One slice of the volume: a rectangle as wide as the grid inside the box, perpendicular to an axis of the box.
#include "common/frame.glsl"
#include "volume/volume.glsl"
#include "shaders/volume/volume_bindings.h"

layout(location = SLICE_AXIS_AT) uniform uint axis;
layout(location = SLICE_PLACE_AT) uniform float place; // position along the axis, m in the box's frame
layout(location = 0) out vec3 box_point;

void main()
{
    vec3 corner = vec3(gl_VertexID & 1, gl_VertexID >> 1, 0.0);
    vec3 share = axis == 0u ? corner.zxy : axis == 1u ? corner.xzy : corner;
    vec3 half_box = 0.5 * box_size;
    box_point = volume_corner + share * vec3(volume_size) / cells_per_m;
    box_point = clamp(box_point, vec3(-half_box.x, 0.0, -half_box.z), vec3(half_box.x, box_size.y, half_box.z));
    box_point[axis] = place;
    vec3 at = (box_to_eye * vec4(box_point, 1.0)).xyz;
    gl_Position = clip_of_eye(at);
}
