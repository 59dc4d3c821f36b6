// The largest value of the field in each brick, including voxels at its faces; beyond walls as in field_at.
#include "volume/raycast.glsl"
#include "shaders/volume/volume_bindings.h"

layout(local_size_x = 64) in;
layout(binding = FIELD_UNIT) uniform sampler3D field_map;
layout(binding = GREATEST_IMAGE, r32f) uniform writeonly image3D greatest_map;

void main()
{
    ivec3 count = ivec3(brick_count), side = ivec3(brick_side);
    int number = int(gl_GlobalInvocationID.x);
    ivec3 brick = ivec3(number % count.x, number / count.x % count.y, number / (count.x * count.y));
    if (brick.z >= count.z)
        return;
    ivec3 least = ivec3(max(floor(field_low * volume_cells - 0.5), vec3(0.0)));
    ivec3 most = ivec3(min(ceil(field_high * volume_cells - 0.5), volume_cells - 1.0));
    ivec3 low = clamp(brick * side, least, most), high = clamp(brick * side + side, least, most);
    float greatest = 0.0;
    for (int z = low.z; z <= high.z; z++)
        for (int y = low.y; y <= high.y; y++)
            for (int x = low.x; x <= high.x; x++)
                greatest = max(greatest, texelFetch(field_map, ivec3(x, y, z), 0).x);
    imageStore(greatest_map, brick, vec4(greatest));
}
