/* Reading by a library that may crash, hang or take all memory over a hostile file: in a process of its own,
   which has 60 s of a processor and 8 GiB, and whose end is an error like another. */
#ifndef SLOSH_MESH_CHILD_H
#define SLOSH_MESH_CHILD_H

#include "sim/mesh/triangles.h"

/* False with the reason; true: the triangles belong to the caller. */
typedef bool MeshRead(const char *path, Triangles *triangles, Error *error);

/* What `read` makes of the path, from the child. For the main thread. */
bool mesh_child_read(MeshRead *read, const char *path, Triangles *triangles, Error *error);

#endif
