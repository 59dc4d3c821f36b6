// The grid of the fluid's field: its values are at the middles of cells.
#include "shaders/pbsr/pbsr_bindings.h"
layout(location = VALUES_SIZE_AT) uniform uvec3 values_size;   // values along each axis
layout(location = VALUES_CORNER_AT) uniform vec3 values_corner; // least corner of the first cell, m
layout(location = VALUES_SIDE_AT) uniform vec3 values_side;     // of a cell, m
layout(location = VALUES_FLAT_AT) uniform uint flat_box;        // 1: in two dimensions, where all layers have the same values

uint values_count()
{
    return values_size.x * values_size.y * values_size.z;
}

uint value_number(uvec3 index)
{
    return index.x + values_size.x * (index.y + values_size.y * index.z);
}

uvec3 value_index(uint i)
{
    uint row = i / values_size.x;
    return uvec3(i % values_size.x, row % values_size.y, row / values_size.y);
}

// m, also between values
vec3 value_place(vec3 index)
{
    return values_corner + (index + 0.5) * values_side;
}
