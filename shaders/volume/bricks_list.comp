// Lists faces between an occupied brick (above the limit) and an empty brick or the volume's outside: brick and direction.
#include "volume/raycast.glsl"
#include "shaders/volume/volume_bindings.h"

layout(local_size_x = 64) in;
layout(binding = GREATEST_UNIT) uniform sampler3D greatest_map;
layout(std430, binding = FACES_STORAGE) writeonly buffer Faces { uint faces[]; };
layout(std430, binding = FACES_COMMAND_STORAGE) buffer Command { uint indices, instances, first, base, offset; };

bool holds(ivec3 brick)
{
    if (any(lessThan(brick, ivec3(0))) || any(greaterThanEqual(brick, ivec3(brick_count))))
        return false;
    return texelFetch(greatest_map, brick, 0).x > brick_least;
}

void main()
{
    ivec3 count = ivec3(brick_count);
    int number = int(gl_GlobalInvocationID.x);
    ivec3 brick = ivec3(number % count.x, number / count.x % count.y, number / (count.x * count.y));
    if (brick.z >= count.z || !holds(brick))
        return;
    for (int side = 0; side < 6; side++) {
        ivec3 to = ivec3(0);
        to[side >> 1] = 2 * (side & 1) - 1;
        if (!holds(brick + to))
            faces[atomicAdd(indices, 6u) / 6u] = uint(6 * number + side);
    }
}
