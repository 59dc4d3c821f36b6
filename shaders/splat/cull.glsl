// Culling of hidden particles by a coarse map, for render/views/splat/splat_sprites.c. A cell holds a depth behind which nothing in the cell is
// visible: the depth of the nearest sprite that covers all pixel centres of the cell. A particle is hidden if its sprite is
// behind all cells that the sprite touches.
#include "shaders/splat/splat_bindings.h"
layout(location = CELLS_AT) uniform uvec2 cell_count; // columns, rows
layout(location = CELL_SIDE_AT) uniform uint cell_side; // pixels
layout(location = CULL_PIXELS_AT) uniform vec2 cull_pixels; // width and height of the picture
layout(std430, binding = CULL_MAP_STORAGE) buffer Nearest { uint nearest[]; }; // bits of nonnegative depths, ordered like the depths
layout(binding = CULL_ROWS_UNIT) uniform usamplerBuffer nearest_rows; // `nearest`, four per fetch: as fast as one word on software drivers

const uint nothing = 0x7f800000u; // infinity

uint texels_a_row()
{
    return (cell_count.x + 3u) / 4u;
}

uint cell_at(uint x, uint y)
{
    return 4u * y * texels_a_row() + x;
}

// The largest depth of the cells x0 .. x1, y0 .. y1, or any value above `enough`.
uint greatest_in(uvec4 cells, uint enough)
{
    uint greatest = 0u, row = cells.z * texels_a_row();
    for (uint y = cells.z; y <= cells.w && greatest <= enough; y++, row += texels_a_row())
        for (uint x = cells.x / 4u; x <= cells.y / 4u; x++) {
            uvec4 at = 4u * x + uvec4(0u, 1u, 2u, 3u), here = texelFetch(nearest_rows, int(row + x));
            bvec4 within = bvec4(uvec4(greaterThanEqual(at, cells.xxxx)) & uvec4(lessThanEqual(at, cells.yyyy)));
            here = mix(uvec4(0u), here, within);
            greatest = max(greatest, max(max(here.x, here.y), max(here.z, here.w)));
        }
    return greatest;
}

