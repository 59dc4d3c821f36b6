// Neighbours of a particle: in nine rows of three cells each, in a slab in three. Positions are texels: a software driver fetches
// texels in half the time of words of a buffer.
#include "common/neighbourhood_grid.glsl"
layout(binding = SORTED_UNIT) uniform usamplerBuffer sorted_texels; // by cell: bits of x y z, the particle's number
layout(std430, binding = STARTS_STORAGE) readonly buffer Starts { uint start[]; };

// First and end index in `sorted` of row 0 to 8; row 0 is the particle's own.
uvec2 row_of(uvec3 at, uint row)
{
    uvec2 yz = at.yz + uvec2((row + 1u) % 3u, (row / 3u + 1u) % 3u) - 1u; // wraps below 0
    if (yz.x >= grid_size.y || yz.y >= grid_size.z)
        return uvec2(0u);
    uint base = cell_number(uvec3(0u, yz));
    uint first = start[base + max(at.x, 1u) - 1u], end = start[base + min(at.x + 2u, grid_size.x)];
    return uvec2(first, min(end, first + crowded));
}

bool in_grid(uint i)
{
    return i < start[grid_size.x * grid_size.y * grid_size.z];
}

vec3 place_of(uint j)
{
    return uintBitsToFloat(texelFetch(sorted_texels, int(j)).xyz);
}

uint number_of(uint j)
{
    return texelFetch(sorted_texels, int(j)).w;
}
