// The grid of render/particles/neighbourhood.c: cells along x are contiguous. An extra cell at the end holds particles far
// outside.
#include "common/nan.glsl"
#include "shaders/shared/bindings.h"
layout(location = GRID_SIZE_AT) uniform uvec3 grid_size; // cells along each axis
layout(location = GRID_PARTICLES_AT) uniform uint grid_particles;
layout(location = GRID_CORNER_AT) uniform vec3 grid_corner; // least corner, m
layout(location = GRID_SCALE_AT) uniform float grid_scale;  // cells per metre
layout(local_size_x = 64) in;

// Limit of particles per cell or row of cells that are visited; fluid has some thirty. Particles collapsed into one position
// would otherwise cost minutes.
const uint crowded = 4096u;

uint invocation()
{
    return gl_GlobalInvocationID.y * gl_NumWorkGroups.x * 64u + gl_GlobalInvocationID.x;
}

// Also true for NaN.
bool beside_grid(vec3 x)
{
    vec3 at = (x - grid_corner) * grid_scale;
    return is_nan(at.xyzz) || any(lessThanEqual(at, vec3(-8.0))) || any(greaterThanEqual(at, vec3(grid_size) + 8.0));
}

// Positions outside the box go to the cells at its sides, so that near particles are in near cells.
uvec3 cell_at(vec3 x)
{
    return uvec3(clamp((x - grid_corner) * grid_scale, vec3(0.0), vec3(grid_size) - 0.5));
}

uint cell_number(uvec3 at)
{
    return (at.z * grid_size.y + at.y) * grid_size.x + at.x;
}
