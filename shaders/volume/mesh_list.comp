// Lists the cubes with a surface: one workgroup a brick, 15 vertices a cube (mesh.vert). Bricks without a node at
// the level are left out at once; the outermost have the cubes at the volume's border as well.
#include "volume/mesh.glsl"

layout(local_size_x = 64) in;
layout(binding = GREATEST_UNIT) uniform sampler3D greatest_map;
layout(std430, binding = MESH_CUBES_STORAGE) writeonly buffer Cubes { uvec2 cubes[]; }; // 16 bits each: x, y; z, case
layout(std430, binding = MESH_COMMAND_STORAGE) buffer Command { uint vertices, instances, first, base; };

void main()
{
    ivec3 brick = ivec3(gl_WorkGroupID), count = ivec3(brick_count), side = ivec3(brick_side);
    if (texelFetch(greatest_map, brick, 0).x < surface_level)
        return;
    ivec3 low = mix(brick * side, ivec3(-1), equal(brick, ivec3(0)));
    ivec3 many = mix(brick * side + side, ivec3(volume_cells), equal(brick, count - 1)) - low;
    for (int i = int(gl_LocalInvocationIndex); i < many.x * many.y * many.z; i += 64) {
        ivec3 cube = low + ivec3(i % many.x, i / many.x % many.y, i / (many.x * many.y));
        int inside = 0;
        for (int corner = 0; corner < 8; corner++)
            inside |= int(node_is_inside(cube_corner(cube, corner))) << corner;
        if (inside == 0 || inside == 255)
            continue;
        uint at = atomicAdd(vertices, 15u) / 15u;
        uvec3 place = uvec3(cube + 1);
        if (at < uint(cubes.length()))
            cubes[at] = uvec2(place.x | place.y << 16, place.z | uint(inside) << 16);
    }
}
