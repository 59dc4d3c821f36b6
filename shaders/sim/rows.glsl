// The neighbours' cells stand in rows of three, nine of them, in two dimensions three: sim/cpu/pairs.h.
layout(std430, binding = 2) readonly buffer Starts { uint start[]; };

ivec3 cell_of(vec3 x)
{
    ivec3 first = cell_first.xyz + 1, last = cell_first.xyz + cell_size.xyz - 2;
    return clamp(ivec3(floor(x * kernel.y)), first, last) - first + 1;
}

uvec2 row_of(ivec3 at, int row)
{
    int middle = ((at.z + row / 3 - 1) * cell_size.y + (at.y + row % 3 - 1)) * cell_size.x + at.x;
    return uvec2(start[middle - 1], start[middle + 2]);
}
