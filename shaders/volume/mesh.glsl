// Nodes of marching cubes: the voxels' centres. A node past a wall is moved onto the wall, so that the mesh is flat there, with a
// sharp edge at the surface. Nodes farther out are outside, so the mesh is closed.
#include "volume/raycast.glsl"
#include "shaders/volume/volume_bindings.h"

layout(binding = FIELD_UNIT) uniform sampler3D field_map;

bool node_is_out(ivec3 node)
{
    vec3 before = (vec3(node) - 0.5) / volume_cells, after = (vec3(node) + 1.5) / volume_cells;
    return any(lessThan(node, ivec3(0))) || any(greaterThanEqual(node, ivec3(volume_cells))) ||
           any(greaterThanEqual(before, wall_high)) || any(lessThanEqual(after, wall_low));
}

// In volume space.
vec3 node_place(ivec3 node)
{
    return clamp((vec3(node) + 0.5) / volume_cells, wall_low, wall_high);
}

// The field as rays see it (field_at); 0 outside.
float node_value(ivec3 node)
{
    vec3 at = node_place(node), inner = clamp(at, field_low, field_high);
    if (node_is_out(node))
        return 0.0;
    return at == inner ? texelFetch(field_map, node, 0).x : textureLod(field_map, inner, 0.0).x;
}

bool node_is_inside(ivec3 node)
{
    return !node_is_out(node) && node_value(node) >= surface_level;
}

ivec3 cube_corner(ivec3 cube, int corner)
{
    return cube + ivec3(corner & 1, corner >> 1 & 1, corner >> 2);
}
