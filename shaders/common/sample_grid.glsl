// Places evenly spread through a box or on a plane: SampleGrid of render/particles.
#include "shaders/shared/bindings.h"
layout(location = SAMPLE_GRID_FIRST_AT) uniform vec3 first; // place, m
layout(location = SAMPLE_GRID_ALONG_AT) uniform vec3 along; // to the next place
layout(location = SAMPLE_GRID_UP_AT) uniform vec3 up;
layout(location = SAMPLE_GRID_DEEP_AT) uniform vec3 deep;
layout(location = SAMPLE_GRID_SIDES_AT) uniform uvec3 sides; // places per row, rows per layer, layers

bool beyond_sample_grid(uint i)
{
    return i >= sides.x * sides.y * sides.z;
}

vec3 sample_grid_place(uint i)
{
    uint row = i / sides.x;
    return first + float(i % sides.x) * along + float(row % sides.y) * up + float(row / sides.y) * deep;
}
