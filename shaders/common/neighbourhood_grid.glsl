// The grid of render/particles/neighbourhood.c: cells along x lie side by side. The one after the last is for what is far beside all.
#include "common/nan.glsl"
#include "shaders/shared/bindings.h"
layout(location = GRID_SIZE_AT) uniform uvec3 grid_size; // cells along each axis
layout(location = GRID_PARTICLES_AT) uniform uint grid_particles;
layout(location = GRID_CORNER_AT) uniform vec3 grid_corner; // the least, m
layout(location = GRID_SCALE_AT) uniform float grid_scale;  // cells a metre
layout(local_size_x = 64) in;

// In a cell or a row of cells; fluid has some thirty there. What collapsed into one place would keep a picture for minutes.
const uint crowded = 4096u;

uint invocation()
{
    return gl_GlobalInvocationID.y * gl_NumWorkGroups.x * 64u + gl_GlobalInvocationID.x;
}

// Also of what is no number.
bool beside_grid(vec3 x)
{
    vec3 at = (x - grid_corner) * grid_scale;
    return is_nan(at.xyzz) || any(lessThanEqual(at, vec3(-8.0))) || any(greaterThanEqual(at, vec3(grid_size) + 8.0));
}

// Beside the box those at its sides: what is near then stands near, too.
uvec3 cell_at(vec3 x)
{
    return uvec3(clamp((x - grid_corner) * grid_scale, vec3(0.0), vec3(grid_size) - 0.5));
}

uint cell_number(uvec3 at)
{
    return (at.z * grid_size.y + at.y) * grid_size.x + at.x;
}
