// Sets the value of points to the field's value at their positions.
#include "surface/field.glsl"
layout(local_size_x = SURFACE_GROUP) in;
layout(std430, binding = SURFACE_STORAGE) buffer Points { float points[]; };
layout(location = SURFACE_RANGE_AT) uniform uvec2 range; // the first word, points

void main()
{
    uint i = gl_GlobalInvocationID.x, at = range.x + SURFACE_WORDS * i;
    if (i < range.y)
        points[at + 5u] = field_at(vec3(points[at], points[at + 1u], points[at + 2u])).value;
}
