// Each voxel sums over the particles around it.
#include "volume/volume.glsl"
#include "volume/field_sum.glsl"
#include "shaders/volume/volume_bindings.h"

layout(local_size_x = 8, local_size_y = 2, local_size_z = 2) in;
layout(binding = FIELD_IMAGE, r32f) uniform writeonly image3D field;
#ifdef SCALAR
layout(binding = FIELD_SCALAR_IMAGE, r32f) uniform writeonly image3D scalar;
#endif

void main()
{
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(cell, volume_size)))
        return;
    vec2 sum = field_sum(vec3(cell) + 0.5);
    imageStore(field, cell, vec4(sum.x));
#ifdef SCALAR
    imageStore(scalar, cell, vec4(sum.y));
#endif
}
