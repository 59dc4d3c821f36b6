/* Private to the import: parts of the reading of meshes. */
#ifndef APP_SCENE_IMPORT_IMPORT_PRIVATE_H
#define APP_SCENE_IMPORT_IMPORT_PRIVATE_H

#include "sim/mesh/mesh_shape.h"

#include <stdbool.h>
#include <stddef.h>

/* Reading of a mesh in a child process, since the library may crash, hang or take all memory over a hostile
   file. The child has some seconds and 8 GiB; a failure of the child is an ordinary error. */

/* Reads a mesh. Returns false with the error set; after true the caller owns the triangles. */
typedef bool MeshRead(const char *path, Triangles *triangles, Error *error);

/* Runs `read` on the path in a child process and takes over the triangles; the caller frees with
   triangles_free. Returns false with the error set. The child is stopped after `seconds` of wall time or of
   processor time, and when the program is interrupted. */
bool mesh_child_read(MeshRead *read, const char *path, double seconds, Triangles *triangles, Error *error);

/* A scene of assimp as a single set of triangles. */

struct aiScene;

/* Bounding box of the scene, by the nodes' matrices in double precision. */
typedef struct MeshBounds {
    double low[3], high[3];
    double largest; /* largest coordinate before node offsets; with several meshes, offsets count as well */
} MeshBounds;

/* True if an STL of `whole` bytes is binary, whatever the first words are. */
bool mesh_is_binary_stl(const char *bytes, size_t size, size_t whole);

#endif
