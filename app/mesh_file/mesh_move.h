/* Moves vertex positions in a file's bytes, in double precision: assimp reads positions as floats, which are
   coarse far from 0. */
#ifndef SLOSH_MESH_MOVE_H
#define SLOSH_MESH_MOVE_H

#include "app/mesh_file/mesh_count.h"

/* Returns the file with `by` subtracted from each position; the caller frees the bytes. Formats: OBJ, text
   STL, PLY in text or with doubles. Returns NULL if the numbers are floats already, the form is unknown, or
   memory is short. */
char *mesh_moved(MeshFormat format, const char *bytes, size_t size, const double by[3], size_t *moved_size);

#endif
