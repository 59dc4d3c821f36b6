/* Particles sorted by the cells of a grid as wide as the kernel's radius, on the GPU. The neighbours of a
   position are in three times three rows of cells (shaders/volume/field_sum.glsl). */
#ifndef SLOSH_CELL_LISTS_H
#define SLOSH_CELL_LISTS_H

#include "render/particles/prefix_sums.h"
#include "render/volume/voxelize.h"

typedef struct CellLists {
    unsigned count, place; /* programs */
    PrefixSums sums;
    unsigned starts, particles, scalars; /* buffers; `scalars` only with a scalar */
    size_t cells, capacity;              /* capacity of the buffers in cells; in particles */
} CellLists;

/* The lists' size for a grid; a list cell is at least `radius` grid cells wide. Returns the number of list
   cells per grid cell. */
double cell_lists_size(const VolumeGrid *grid, double radius, int size[3]);

/* Returns false if a shader does not compile; call cell_lists_destroy in either case. */
bool cell_lists_create(CellLists *lists, bool scalar, Error *error);
void cell_lists_destroy(CellLists *lists);

/* Makes the lists, and leaves the buffers bound. */
void cell_lists_make(CellLists *lists, const VoxelizeJob *job);
void cell_lists_bind(const CellLists *lists);

#endif
