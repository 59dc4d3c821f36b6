// Numbering of cells and their neighbours: sim/cpu/grid.c, sim/step/cells.c.
ivec3 cell_of(vec3 x)
{
    ivec3 first = first_cell + 1, last = first_cell + grid_size - 2;
#ifdef PERIODIC
    return clamp(ivec3(floor((x - cell_origin) * cell_inverse)), first, last) - first + 1;
#else
    return clamp(ivec3(floor(x * inverse_support)), first, last) - first + 1;
#endif
}

// Place of a cell: sim/step/backend.h.
int cell_place(ivec3 at) { return ((cell_fold.x * at.y + cell_fold.y * at.z) & cell_fold.z) + at.x; }

// Places of a row's first cell and of the cell after the row. With periodic sides a row is a single cell, and
// particles there see a particle at x as if at x + row_shift.
#ifdef PERIODIC
#define FIRST_ROW first_single_row
#define LAST_ROW last_single_row

ivec3 row_offset(int row) { return ivec3(row % 3, row / 3 % 3, row / 9) - 1; }

vec3 row_shift(ivec3 at, int row)
{
    ivec3 cell = at + row_offset(row), cells = grid_size - 2;
    vec3 side = vec3(lessThan(cell, ivec3(1))) - vec3(greaterThan(cell, cells));
    return mix(vec3(0), side * box_whole, periodic);
}

ivec2 row_cells(ivec3 at, int row)
{
    ivec3 cell = at + row_offset(row), cells = grid_size - 2;
    ivec3 inside = cell + cells * (ivec3(lessThan(cell, ivec3(1))) - ivec3(greaterThan(cell, cells)));
    int place = cell_place(ivec3(mix(vec3(cell), vec3(inside), periodic)));
#ifdef BEHIND_DRIFT
    // A further row has the same particles: cell_row_again of sim/step/cells.c.
    if (any(bvec3(mix(vec3(0), vec3(notEqual(cell, inside)) * vec3(equal(cells, ivec3(2))), periodic))))
        return ivec2(place);
#endif
    return ivec2(place, place + 1);
}

#ifndef BEHIND_DRIFT
vec3 row_seen(vec3 x, ivec3 at, int row) { return x + row_shift(at, row); }
#endif

// The nearest image of a difference of positions.
vec3 nearest(vec3 d) { return d - mix(vec3(0), box_whole * roundEven(d / box_whole), periodic); }
#ifdef BEHIND_DRIFT
vec3 row_seen(vec3 x, ivec3 at, int row) { return x; }
#define APART(d) nearest(d)
#endif
#else
#define FIRST_ROW first_row
#define LAST_ROW last_row

ivec2 row_cells(ivec3 at, int row)
{
    int middle = cell_place(at + ivec3(0, row % 3 - 1, row / 3 - 1));
    return ivec2(middle - 1, middle + 2);
}

vec3 row_seen(vec3 x, ivec3 at, int row) { return x; }

vec3 nearest(vec3 d) { return d; }
#endif
