// The grid of a volume, and its particles in units of its cells; filled by render/volume/voxelizer.c, same order as VolumeBlock there.
layout(std140, binding = 2) uniform VolumeBlock {
    vec4 volume_place;  // corner, m; cells a m
    vec4 volume_low;    // what particles may count, m; radius of the kernel, cells
    vec4 volume_high;   // the same; 1 / radius^2
    ivec4 volume_size;  // cells; particles
    ivec4 list_size;    // cells of the lists; -
    vec4 volume_scale;  // W(0), 1/m3; cells of the lists a cell of the grid; -
};

vec3 cells_of(vec3 box_point)
{
    return (box_point - volume_place.xyz) * volume_place.w;
}

// (1 - r^2 / h^2)^3 from the part of it that is not squared yet: poly6 of Müller 2003, eq. 20, without its factor.
float poly6_shape(float rest)
{
    float t = max(rest, 0.0);
    return t * t * t;
}
