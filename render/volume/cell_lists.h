/* Particles in the order of the cells of a grid as wide as the kernel's radius, made on the GPU: who is near
   a place stands in three times three rows (shaders/volume/field_sum.glsl). */
#ifndef SLOSH_CELL_LISTS_H
#define SLOSH_CELL_LISTS_H

#include "render/particles/prefix_sums.h"
#include "render/volume/voxelize.h"

typedef struct CellLists {
    unsigned count, place; /* programs */
    PrefixSums sums;
    unsigned starts, particles, scalars; /* buffers; the last where a scalar is carried */
    size_t cells, capacity;              /* that the buffers have room for; the same of particles */
} CellLists;

/* The lists' size for a grid; their cells are at least `radius` cells of the grid wide. Returns how many a
   cell of the grid is. */
double cell_lists_size(const VolumeGrid *grid, double radius, int size[3]);

/* False when a shader does not compile; cell_lists_destroy is needed in either case. */
bool cell_lists_create(CellLists *lists, bool scalar, Error *error);
void cell_lists_destroy(CellLists *lists);

/* Makes the lists, and leaves them bound. */
void cell_lists_make(CellLists *lists, const VoxelizeJob *job);
void cell_lists_bind(const CellLists *lists);

#endif
