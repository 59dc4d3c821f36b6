/* Reading of a mesh in a child process, since the library may crash, hang or take all memory over a hostile
   file. The child has some seconds and 8 GiB; a failure of the child is an ordinary error. */
#ifndef SLOSH_MESH_CHILD_H
#define SLOSH_MESH_CHILD_H

#include "sim/mesh/triangles.h"

/* Reads a mesh. Returns false with the error set; after true the caller owns the triangles. */
typedef bool MeshRead(const char *path, Triangles *triangles, Error *error);

/* Runs `read` on the path in a child process and takes over the triangles; the caller frees with
   triangles_free. Returns false with the error set. The child is stopped after `seconds` of wall time or of
   processor time, and when the program is interrupted. */
bool mesh_child_read(MeshRead *read, const char *path, double seconds, Triangles *triangles, Error *error);

#endif
