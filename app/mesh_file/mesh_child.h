/* Reading by a library that may crash, hang or take all memory over a hostile file: in a process of its own,
   which has some seconds and 8 GiB, and whose end is an error like another. */
#ifndef SLOSH_MESH_CHILD_H
#define SLOSH_MESH_CHILD_H

#include "sim/mesh/triangles.h"

/* False with the reason; true: the triangles belong to the caller. */
typedef bool MeshRead(const char *path, Triangles *triangles, Error *error);

/* What `read` makes of the path, from the child, that is stopped after so many seconds, of wall time and of a
   processor's, and when the program is interrupted. */
bool mesh_child_read(MeshRead *read, const char *path, double seconds, Triangles *triangles, Error *error);

#endif
