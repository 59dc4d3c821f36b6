// The walk over the neighbours of a place x: what stands in the cells around `at`, the cell of x, row by row. The cells
// stand in rows of three, nine of them, in two dimensions three: sim/cpu/pair_args.h.
//
// WALK(x, at, meet, meet_boundary) calls meet(j, d, w) for each particle, and meet_boundary(j, d, w) for each boundary
// particle of solids, of whatever distance: j is its index, d = x - where it stands, w the fourth number of its place.
// What they find goes into variables of the shader. WALK_FLUID leaves boundary particles out; WALK_ROWS does `row_done`
// behind each row. A shader declares position[] itself; one that wants another number with each place defines PLACES,
// where these stand.
//
// WALK_NEIGHBOURS is for what stands at its own place in the grid, particle i: of the fluid it may leave out what is h or
// further away. The first pass of a step walks, and makes a list; the others of the step read it: lists.glsl.
// WALK_AGAIN is for the pass that makes the list, behind that: for the images of i, who see no one else.
// A pass that walks though particles have moved since the grid was made defines BEHIND_DRIFT: some have gone through a side.
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
