/* Particles next to a cell of the grid, also across periodic sides. */
#ifndef SLOSH_CELL_ROWS_H
#define SLOSH_CELL_ROWS_H

#include "sim/world/cell_fold.h"

/* Particles [begin, end), as seen from x + shift; m. */
typedef struct CellRow {
    uint32_t begin, end;
    float shift[3]; /* 0 except across a periodic side */
} CellRow;

enum { CELL_ROWS = 18 };

/* Fills rows with all particles in `cell` and the cells around, for particles sorted by cell. `start`:
   first particle of each place of `fold`, plus an extra entry. Particles of distant cells that share a
   place are included. Returns the number of rows. */
int cell_rows(const Constants *constants, const CellFold *fold, const uint32_t *start, uint32_t cell,
              CellRow rows[CELL_ROWS]);

/* The cell at x (m) or next to x with the given place: for particles that have moved since the grid was
   made. */
uint32_t cell_near(const Constants *constants, const CellFold *fold, size_t place, const float x[3]);

/* True if a further row has the same particles: along a periodic axis of two cells, both neighbours of a
   cell are the same cell. For callers that take the nearest image of a pair and ignore the row's shift. */
bool cell_row_again(const Constants *constants, const CellRow *row);

#endif
