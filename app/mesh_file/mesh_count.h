/* How many triangles a file of a mesh says that it has, before anybody reads it. */
#ifndef SLOSH_MESH_COUNT_H
#define SLOSH_MESH_COUNT_H

#include <stdbool.h>
#include <stddef.h>

typedef enum MeshFormat { MESH_OBJ, MESH_PLY, MESH_STL, MESH_GLTF, MESH_GLB, MESH_UNKNOWN } MeshFormat;

/* By the ending of a file's name, whatever its case. */
MeshFormat mesh_format(const char *path);

/* Of a file of `whole` bytes, of which the first `size` are here: a binary STL and a PLY say it in their
   heads, lines of an OBJ and a text STL are counted as far as they are here. 0 where nothing says it. Pure.
 */
double mesh_count(MeshFormat format, const char *bytes, size_t size, size_t whole);

/* Whether the head of a PLY, all of whose bytes are here, has its last line; of other formats always. assimp
   looks for it for ever. Pure. */
bool mesh_has_head(MeshFormat format, const char *bytes, size_t size);

/* Whether an STL of `whole` bytes is a binary one, whatever words it begins with. */
bool mesh_is_binary_stl(const char *bytes, size_t size, size_t whole);

#endif
