/* Meshes from files, by assimp: OBJ, PLY, STL, glTF. */
#ifndef SLOSH_MESH_FILE_H
#define SLOSH_MESH_FILE_H

#include "sim/mesh/mesh_shape.h"

enum { MESH_FILE_MIB_MAX = 256 };

/* The mesh of a file, whose distances are at hand. It lives as long as the program: scenes are copied, and
   worlds made of them, with nobody to own it; a file with the same bytes is kept once. NULL with "what is
   wrong; what would be right", without the file's name. */
const MeshShape *mesh_file_load(const char *path, MeshState *state, Error *error);

/* From now on, while a mesh is read for this thread, `call` is called again and again: a window goes on
   meanwhile. What it does may load meshes too, and is not called for those. NULL: nothing. */
void mesh_file_meanwhile(void (*call)(void *user), void *user);

/* The triangles as the file has them, of all its parts. False: it is missing, of no known format, too large.
 */
bool mesh_file_read(const char *path, Triangles *triangles, Error *error);

#endif
