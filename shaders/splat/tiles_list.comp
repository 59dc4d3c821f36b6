// Converts marks of tiles to rectangles, one per run of tiles in a row. One workgroup does all the work; the order of the
// rectangles does not matter.
#include "shaders/splat/splat_bindings.h"
layout(local_size_x = 64) in;
layout(location = TILES_BOUNDS_AT) uniform ivec4 bounds;    // also counts as marked, pixels
layout(location = TILES_PICTURE_AT) uniform uvec2 picture; // pixels
layout(std430, binding = TILE_MARKS_STORAGE) buffer Marks { uint tile_mark[]; }; // 0: not marked
layout(std430, binding = TILE_RECTS_STORAGE) writeonly buffer Rects { uvec4 rect[]; };
layout(std430, binding = TILE_COMMAND_STORAGE) writeonly buffer Command { uint command[]; };
shared uint rects;

bool in_bounds(uvec2 tile)
{
    ivec2 low = ivec2(tile) * TILE;
    return all(greaterThan(low + TILE, bounds.xy - TILE_MARGIN)) && all(lessThan(low, bounds.zw + TILE_MARGIN)) && bounds.z > bounds.x;
}

// True if the tile is to be drawn. Clears the mark, which is for one picture.
bool taken(uvec2 tile, uint columns)
{
    uint at = tile.y * columns + tile.x;
    bool marked = tile_mark[at] > 0u;
    tile_mark[at] = 0u;
    return marked || in_bounds(tile);
}

void add(uint row, uint first, uint end)
{
    rect[atomicAdd(rects, 1u)] = uvec4(uvec2(first, row) * TILE, min(uvec2(end, row + 1u) * TILE, picture));
}

void list_row(uint row, uint columns)
{
    uint first = 0u;
    for (uint column = 0u; column < columns; column++)
        if (!taken(uvec2(column, row), columns)) {
            if (first < column)
                add(row, first, column);
            first = column + 1u;
        }
    if (first < columns)
        add(row, first, columns);
}

void main()
{
    uvec2 tiles = (picture + uint(TILE - 1)) / TILE;
    if (gl_LocalInvocationID.x == 0u)
        rects = 0u;
    barrier();
    for (uint row = gl_LocalInvocationID.x; row < tiles.y; row += 64u)
        list_row(row, tiles.x);
    barrier();
    if (gl_LocalInvocationID.x == 0u) { // count, instances, first, base instance
        command[0] = 6u * rects;
        command[1] = 1u;
        command[2] = 0u;
        command[3] = 0u;
    }
}
