// Sorts positions by cell, and within a cell by number, so that sums have a fixed order whatever the order of the atomics. Each
// particle counts its rank itself, as in sim/compute/sort.comp; particles without a cell, or in an overfull cell, keep any rank.
#include "common/particles.glsl"
#include "common/neighbourhood_grid.glsl"
layout(std430, binding = CELLS_STORAGE) readonly buffer Cells { uint cell[]; };
layout(std430, binding = ORDER_STORAGE) readonly buffer Orders { uint order[]; };
layout(binding = ORDER_UNIT) uniform usamplerBuffer order_texels; // `order`, four per fetch: as fast as one word on software drivers
layout(std430, binding = STARTS_STORAGE) readonly buffer Starts { uint start[]; };
layout(std430, binding = SORTED_STORAGE) writeonly buffer Sorted { uvec4 sorted[]; };

void main()
{
    uint at = invocation();
    if (at >= grid_particles)
        return;
    uint i = order[at], c = cell[i], first = start[c], end = start[c + 1u], place = first;
    if (c == grid_size.x * grid_size.y * grid_size.z || end - first > crowded)
        place = at, end = first;
    for (uint j = first & ~3u; j < end; j += 4u) {
        uvec4 there = texelFetch(order_texels, int(j / 4u)), number = j + uvec4(0u, 1u, 2u, 3u);
        uvec4 before = uvec4(lessThan(there, uvec4(i))) & uvec4(greaterThanEqual(number, uvec4(first))) & uvec4(lessThan(number, uvec4(end)));
        place += before.x + before.y + before.z + before.w;
    }
    sorted[place] = uvec4(floatBitsToUint(particle_position(i)), i);
}
