// The coarse level of a solver, as sim/cpu/coarse.c has it, in float: cells of several cells of the grid. COARSE_INNER,
// COARSE_COUNT, COARSE_ALONG and COARSE_WIDE are the CoarseShape of sim/step/backend.h.

#include "shaders/sim/coarse_block.h"

// The coarse cell of a cell of the grid, at 1 and more along each axis.
ivec3 coarse_cell_of(ivec3 at) { return min((at - 1) / COARSE_WIDE, COARSE_COUNT - 1); }

// Cells of the grid along each axis of a coarse cell.
ivec3 coarse_width(ivec3 cell)
{
    return ivec3(mix(vec3(COARSE_WIDE), vec3(COARSE_INNER - cell * COARSE_WIDE), equal(cell, COARSE_COUNT - 1)));
}

// A particle in a coarse cell, 0 to 1 along each axis.
vec3 coarse_place(vec3 x, ivec3 cell)
{
    vec3 from = vec3(first_cell + 1 + cell * COARSE_WIDE);
    vec3 at = clamp(((x - cell_origin) * cell_inverse - from) / vec3(coarse_width(cell)), 0.0, 1.0);
    return dimensions == 2 ? vec3(at.xy, 0) : at;
}

int coarse_number(ivec3 at, ivec3 count) { return (at.z * count.y + at.y) * count.x + at.x; }

// The node at a corner of a cell: across a periodic side, and in the plane along z, the first node again.
int coarse_node(ivec3 cell, int corner)
{
    ivec3 at = cell + (ivec3(corner) >> ivec3(0, 1, 2) & 1);
    return coarse_number(ivec3(mix(vec3(at), vec3(0), equal(at, COARSE_ALONG))), COARSE_ALONG);
}
