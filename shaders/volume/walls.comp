// Fluid continues behind a wall as its mirror image: the field behind the wall is added in front. Otherwise fluid would end half
// a spacing before the wall, with rounded edges.
#include "volume/volume.glsl"
#include "shaders/volume/volume_bindings.h"

layout(local_size_x = 64) in;
layout(binding = FIELD_IMAGE, r32f) uniform image3D sums;
layout(location = WALL_AXIS_AT) uniform int axis;
layout(location = WALL_PLACE_AT) uniform float wall; // cells
layout(location = WALL_CELLS_AT) uniform ivec3 cells; // first cell at the wall along the axis; number of cells; 1 or -1: direction away from the wall

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
    // The image's position between two cells. Both cells are behind the wall, or are this cell: other invocations write neither.
    float image = 2.0 * wall - float(cell[axis]) - 1.0, low = floor(image);
    float there = mix(sum_at(along(cell, int(low))), sum_at(along(cell, int(low) + 1)), image - low);
    imageStore(sums, cell, vec4(imageLoad(sums, cell).x + there));
}
