// Fluid goes on behind a wall as its mirror image: what the field has behind a wall is added before it. Without that a fluid would end
// half a spacing before the wall, with rounded edges.
#include "volume/volume.glsl"
#include "shaders/volume/volume_bindings.h"

layout(local_size_x = 64) in;
layout(binding = FIELD_IMAGE, r32f) uniform image3D sums;
layout(location = WALL_AXIS_AT) uniform int axis;
layout(location = WALL_PLACE_AT) uniform float wall; // cells
layout(location = WALL_CELLS_AT) uniform ivec3 cells; // the first before the wall along the axis, how many, and 1 or -1: away from it

ivec3 along(ivec3 cell, int place)
{
    cell[axis] = place;
    return cell;
}

float sum_at(ivec3 cell)
{
    return cell[axis] < 0 || cell[axis] >= volume_size[axis] ? 0.0 : imageLoad(sums, cell).x;
}

void main()
{
    ivec3 count = along(volume_size, cells.y);
    int number = int((gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x);
    ivec3 cell = ivec3(number % count.x, number / count.x % count.y, number / (count.x * count.y));
    if (cell.z >= count.z)
        return;
    cell[axis] = cells.x + cells.z * cell[axis];
    if (cell[axis] < 0 || cell[axis] >= volume_size[axis])
        return;
    // The image's place between two cells. Both are behind the wall, or this cell itself: none that another invocation writes.
    float image = 2.0 * wall - float(cell[axis]) - 1.0, low = floor(image);
    float there = mix(sum_at(along(cell, int(low))), sum_at(along(cell, int(low) + 1)), image - low);
    imageStore(sums, cell, vec4(imageLoad(sums, cell).x + there));
}
