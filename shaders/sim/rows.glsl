// The neighbours' cells stand in rows of three, nine of them, in two dimensions three: sim/cpu/pairs.h.
#include "sim/cells.glsl"
layout(std430, binding = 2) readonly buffer Starts { uint start[]; };

uvec2 row_of(ivec3 at, int row)
{
    ivec2 cells = row_cells(at, row);
    return uvec2(start[cells.x], start[cells.y]);
}
