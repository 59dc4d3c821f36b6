// The walk over the neighbours of a position x: particles in the cells around `at`, the cell of x, row by row. There
// are nine rows of three cells, in two dimensions three rows: sim/cpu/pairs.h.
//
// WALK(x, at, meet, meet_boundary) calls meet(j, d, w) for each particle, and meet_boundary(j, d, w) for each
// boundary particle of solids, at any distance. j: index; d: x minus the particle's position; w: fourth number of its
// place. Results go to variables of the shader. WALK_FLUID skips boundary particles; WALK_ROWS runs `row_done` after
// each row. A shader declares position[] itself; a shader with a different fourth number defines PLACES as the
// array's name.
//
// WALK_NEIGHBOURS is for particle i at its own place in the grid: may skip fluid at distance h or more. The first
// pass of a step walks and makes a list; later passes of the step read it: lists.glsl. WALK_AGAIN is for the pass
// that makes the list, after WALK_NEIGHBOURS: for the images of i, which see no further particles. A pass that walks
// after particles have moved since the grid defines BEHIND_DRIFT: some particles have crossed a side.
#ifndef PLACES
#define PLACES position
#endif
#include "sim/cells.glsl"
#ifndef APART
#define APART(d) (d)
#endif
#include "sim/boundary.glsl"
layout(std430, binding = STARTS_BUFFER) readonly buffer Starts { uint start[]; };

uvec2 row_of(ivec3 at, int row)
{
    ivec2 cells = row_cells(at, row);
    return uvec2(start[cells.x], start[cells.y]);
}

#include "sim/lists.glsl"

#define WALK_RANGE(range_of_row, place, meet)               \
    {                                                       \
        uvec2 range = range_of_row;                         \
        for (uint j = range.x; j < range.y; j++) {          \
            vec4 other = place[j];                          \
            meet(j, APART(seen_from - other.xyz), other.w); \
        }                                                   \
    }

#define WALK_FLUID(x, at, meet)                             \
    for (int row = FIRST_ROW; row < LAST_ROW; row++) {      \
        vec3 seen_from = row_seen(x, at, row);              \
        WALK_RANGE(row_of(at, row), PLACES, meet)           \
    }

#ifdef SOLIDS
#define WALK_ROWS(x, at, meet, meet_boundary, row_done)                         \
    for (int row = FIRST_ROW; row < LAST_ROW; row++) {                          \
        vec3 seen_from = row_seen(x, at, row);                                  \
        WALK_RANGE(row_of(at, row), PLACES, meet)                               \
        WALK_RANGE(boundary_row_of(at, row), boundary_position, meet_boundary)  \
        row_done;                                                               \
    }
#define WALK(x, at, meet, meet_boundary) WALK_ROWS(x, at, meet, meet_boundary, 0)
#else
#define WALK_ROWS(x, at, meet, meet_boundary, row_done) WALK_FLUID(x, at, meet)
#define WALK(x, at, meet, meet_boundary) WALK_FLUID(x, at, meet)
#endif

#ifdef LISTS
#define WALK_NEIGHBOURS(i, x, at, meet, meet_boundary, row_done)    \
    WALK_LISTED(i, x, at, meet)                                     \
    WALK_BOUNDARY(x, at, meet_boundary, row_done)
#define WALK_AGAIN(i, x, at, meet, meet_boundary)                   \
    {                                                               \
        WALK_KEPT(i, x, at, meet)                                   \
        WALK_BOUNDARY(x, at, meet_boundary, 0)                      \
    }
#else
#define WALK_NEIGHBOURS(i, x, at, meet, meet_boundary, row_done) WALK_ROWS(x, at, meet, meet_boundary, row_done)
#define WALK_AGAIN(i, x, at, meet, meet_boundary) { WALK(x, at, meet, meet_boundary) }
#endif
