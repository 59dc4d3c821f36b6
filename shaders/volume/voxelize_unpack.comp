// Four slices from red, green, blue, alpha to the volume.
#include "volume/volume.glsl"
#include "shaders/volume/volume_bindings.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = PACKED_UNIT) uniform sampler3D packed_map;
layout(binding = UNPACKED_IMAGE, r32f) uniform writeonly image3D unpacked;

void main()
{
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(cell.xy, volume_size.xy)))
        return;
    vec4 four = texelFetch(packed_map, cell, 0);
    for (int k = 0; k < 4 && 4 * cell.z + k < volume_size.z; k++)
        imageStore(unpacked, ivec3(cell.xy, 4 * cell.z + k), vec4(four[k]));
}
