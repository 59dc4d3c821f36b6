// The grid of render/particles/neighbourhood.c: cells along x lie side by side. The one after the last is for what is far beside all.
#include "common/nan.glsl"
layout(location = 1) uniform uvec4 grid_size;  // cells along each axis; particles
layout(location = 2) uniform vec4 grid_place;  // least corner, m; cells a metre
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
    vec3 at = (x - grid_place.xyz) * grid_place.w;
    return is_nan(at.xyzz) || any(lessThanEqual(at, vec3(-8.0))) || any(greaterThanEqual(at, vec3(grid_size.xyz) + 8.0));
}

// Beside the box those at its sides: what is near then stands near, too.
uvec3 cell_at(vec3 x)
{
    return uvec3(clamp((x - grid_place.xyz) * grid_place.w, vec3(0.0), vec3(grid_size.xyz) - 0.5));
}

uint cell_number(uvec3 at)
{
    return (at.z * grid_size.y + at.y) * grid_size.x + at.x;
}
