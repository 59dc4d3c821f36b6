/* Which particles stand next to a cell of the grid, across periodic sides too. */
#ifndef SLOSH_CELL_ROWS_H
#define SLOSH_CELL_ROWS_H

#include "sim/world/cell_fold.h"

/* Particles [begin, end), as seen by who stands at x + shift; m. */
typedef struct CellRow {
    uint32_t begin, end;
    float shift[3]; /* 0 but across a periodic side */
} CellRow;

enum { CELL_ROWS = 18 };

/* All that stand in the cells next to `cell`, itself included, of particles sorted by cell: `start` has the
   first of each place of `fold`, and one more. Who is of a cell elsewhere that shares a place stands there
   too. Returns how many rows it fills. */
int cell_rows(const Constants *constants, const CellFold *fold, const uint32_t *start, uint32_t cell,
              CellRow rows[CELL_ROWS]);

/* The cell at x (m) or next to it that has this place: of who was there when the grid was made, and has moved
   since. */
uint32_t cell_near(const Constants *constants, const CellFold *fold, size_t place, const float x[3]);

/* Whether another row has all that stand in this one: across a side of which the box is two cells wide, both
   neighbours of a cell are the same. For who takes the nearest image of a pair, whatever the row's shift. */
bool cell_row_again(const Constants *constants, const CellRow *row);

#endif
