/* Numbering of cells for counting particles. With few cells per particle, each cell has its own place: the
   cell number. In a mostly empty box, cells share a table with some places per particle, as in Teschner et
   al., "Optimized spatial hashing for collision detection of deformable objects", 2003. So empty space
   costs neither time nor memory.

   Cells of a row along x stay contiguous in the table, and no two cells of a walk share a place. So a walk
   meets each particle once, and some particles of distant cells, further away than h. Sums over neighbours
   have the same terms in the same order as without a table. */
#ifndef SLOSH_CELL_FOLD_H
#define SLOSH_CELL_FOLD_H

#include "sim/world/constants.h"

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

#endif
