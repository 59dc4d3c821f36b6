/* Meshes from files, by assimp: OBJ, PLY, STL, glTF. */
#ifndef SLOSH_MESH_FILE_H
#define SLOSH_MESH_FILE_H

#include "sim/mesh/mesh_shape.h"

enum { MESH_FILE_MIB_MAX = 256 };

/* Loads the mesh of a file, with the distance grid. The mesh lives as long as the program: copies of scenes,
   and worlds, share the mesh, and none is the owner. Files with equal bytes share a mesh. Returns NULL with
   the error "what is wrong; what would be right", without the file's name. */
const MeshShape *mesh_file_load(const char *path, MeshState *state, Error *error);

/* From now on, calls `call` repeatedly while a mesh is read for this thread, so that a window stays alive.
   `call` may load meshes as well, without further calls. NULL: no calls. */
void mesh_file_meanwhile(void (*call)(void *user), void *user);

/* Reads the triangles of all parts of a file, without repair; a mesh far from 0 is moved to 0. The caller
   frees with triangles_free. Returns false if the file is missing, of unknown format, or too large, or cannot
   be read. */
bool mesh_file_read(const char *path, Triangles *triangles, Error *error);

#endif
