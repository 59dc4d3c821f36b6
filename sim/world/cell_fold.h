/* Where particles are counted by cell. In a box with few cells for its particles each cell has a place of
 * its own, its number. In a box that is mostly empty cells share a table of some places a particle, as in
 * Teschner et al., "Optimized spatial hashing for collision detection of deformable objects", 2003, so that
 * empty space costs neither time nor memory. Cells of a row along x follow each other there too, and no two
 * of the cells that one walk visits share a place: a walk meets everybody once, those of other cells too, who
 * are further away than h. Sums over neighbours have the same terms in the same order as without a table. */
#ifndef SLOSH_CELL_FOLD_H
#define SLOSH_CELL_FOLD_H

#include "sim/world/constants.h"

typedef struct CellFold {
    uint32_t y, z, mask; /* cell (i, j, k) of the grid is at ((y j + z k) & mask) + i */
    size_t count;        /* of places */
    bool shared;         /* cells share places */
} CellFold;

/* For so many particles. */
CellFold cell_fold(const Constants *constants, size_t particles);

/* Each cell by itself. */
CellFold cell_fold_plain(const CellGrid *cells);

static inline uint32_t cell_fold_at(const CellFold *fold, uint32_t x, uint32_t y, uint32_t z)
{
    return ((fold->y * y + fold->z * z) & fold->mask) + x;
}

/* Of a cell by its number; behind all places for the number behind all cells. */
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
