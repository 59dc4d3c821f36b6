// The fluid's field at a position, m in the box's frame: from the volume, or with FIELD_DIRECT summed at the position. Bound by
// voxelizer_bind (render/views/volume/volume_private.h); needs voxelizer_defines in front.
#include "volume/volume.glsl"
#include "shaders/volume/volume_bindings.h"

#ifdef FIELD_DIRECT
#include "volume/field_sum.glsl"

float field_at(vec3 box_point)
{
    return field_sum(cells_of(box_point)).x;
}
#else
layout(binding = FIELD_UNIT) uniform sampler3D field_map;

float field_at(vec3 box_point)
{
    return textureLod(field_map, cells_of(box_point) / vec3(volume_size), 0.0).x;
}
#endif

#ifdef SCALAR
#ifdef FIELD_DIRECT
vec2 field_sums_at(vec3 box_point)
{
    return field_sum(cells_of(box_point));
}
#else
layout(binding = FIELD_SCALAR_UNIT) uniform sampler3D field_scalar_map;

vec2 field_sums_at(vec3 box_point)
{
    return vec2(field_at(box_point), textureLod(field_scalar_map, cells_of(box_point) / vec3(volume_size), 0.0).x);
}
#endif

// The mean of the scalar; 0 without fluid.
float field_scalar_at(vec3 box_point)
{
    vec2 sums = field_sums_at(box_point);
    return sums.x > 0.0 ? sums.y / sums.x : 0.0;
}
#endif
