/* Numbering of cells for counting particles. With few cells per particle, each cell has its own place: the
   cell number. In a mostly empty box, cells share a table with some places per particle, as in Teschner et
   al., "Optimized spatial hashing for collision detection of deformable objects", 2003. So empty space
   costs neither time nor memory.

   Cells of a row along x stay contiguous in the table, and no two cells of a walk share a place. So a walk
   meets each particle once, and some particles of distant cells, further away than h. Sums over neighbours
   have the same terms in the same order as without a table. */
#ifndef SIM_STEP_CELLS_H
#define SIM_STEP_CELLS_H

#include "sim/step/constants.h"

typedef struct CellFold {
    uint32_t y, z, mask; /* cell (i, j, k) of the grid is at ((y j + z k) & mask) + i */
    size_t count;        /* of places */
    bool shared;         /* cells share places */
} CellFold;

/* A fold for `particles` particles. */
CellFold cell_fold(const Constants *constants, size_t particles);

/* A place per cell, no sharing. */
CellFold cell_fold_plain(const CellGrid *cells);

static inline uint32_t cell_fold_at(const CellFold *fold, uint32_t x, uint32_t y, uint32_t z)
{
    return ((fold->y * y + fold->z * z) & fold->mask) + x;
}

/* Place of a cell number; one past all places for a number past all cells. */
static inline uint32_t cell_fold_of(const CellFold *fold, const CellGrid *cells, uint32_t cell)
{
    const uint32_t width = (uint32_t)cells->size[0], height = (uint32_t)cells->size[1];
    if (!fold->shared)
        return cell;
    if (cell >= cells->count)
        return (uint32_t)fold->count;
    return cell_fold_at(fold, cell % width, cell / width % height, cell / width / height);
}

/* Particles next to a cell of the grid, also across periodic sides. */

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
bool cell_row_repeats(const Constants *constants, const CellRow *row);

#endif
