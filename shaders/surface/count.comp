// Counts the points in each counting sphere (sim/points/points.h), an invocation per point.
#include "shaders/surface/surface_bindings.h"
layout(local_size_x = SURFACE_GROUP) in;
layout(std430, binding = SURFACE_STORAGE) readonly buffer Points { float points[]; };
layout(std430, binding = SPHERES_STORAGE) readonly buffer Spheres { vec4 spheres[]; };          // centre
layout(std430, binding = SPHERE_CELLS_STORAGE) readonly buffer Cells { uint sphere_cells[]; }; // the first entry of each cell; then the numbers of
                                                                                               // the spheres
layout(std430, binding = COUNTS_STORAGE) buffer Counts { uint counts[]; };
layout(location = SURFACE_RANGE_AT) uniform uvec2 range;        // the first word, points
layout(location = SPHERES_LOW_AT) uniform vec3 spheres_low;     // low corner of the cells
layout(location = SPHERES_CELL_AT) uniform vec3 spheres_cell;   // 1 / m
layout(location = SPHERES_RADIUS_AT) uniform vec3 sphere_range; // radius; cells along an axis; number of cells

void main()
{
    uint i = gl_GlobalInvocationID.x, at = range.x + SURFACE_WORDS * i;
    if (i >= range.y)
        return;
    vec3 p = vec3(points[at], points[at + 1u], points[at + 2u]);
    uint side = uint(sphere_range.y), all_cells = uint(sphere_range.z);
    uvec3 cell = uvec3(clamp((p - spheres_low) * spheres_cell, vec3(0.0), vec3(float(side - 1u))));
    uint c = cell.x + side * (cell.y + side * cell.z);
    for (uint m = sphere_cells[c]; m < sphere_cells[c + 1u]; m++) {
        uint sphere = sphere_cells[all_cells + 1u + m];
        vec3 off = p - spheres[sphere].xyz;
        if (dot(off, off) < sphere_range.x * sphere_range.x)
            atomicAdd(counts[sphere], 1u);
    }
}
