/* Places of a mesh moved in a file's bytes, in double precision: assimp reads places into floats, which far
   from 0 are far apart. */
#ifndef SLOSH_MESH_MOVE_H
#define SLOSH_MESH_MOVE_H

#include "app/mesh_file/mesh_count.h"

/* The same file with `by` taken from each place, which the caller frees: an OBJ, a text STL, a PLY in text or
   of doubles. NULL: the numbers are floats already, the form is not known, or memory is short. */
char *mesh_moved(MeshFormat format, const char *bytes, size_t size, const double by[3], size_t *moved_size);

#endif
