/* Number of triangles that a mesh file states, known before a full read. */
#ifndef SLOSH_MESH_COUNT_H
#define SLOSH_MESH_COUNT_H

#include <stdbool.h>
#include <stddef.h>

typedef enum MeshFormat { MESH_OBJ, MESH_PLY, MESH_STL, MESH_GLTF, MESH_GLB, MESH_UNKNOWN } MeshFormat;

/* Format by the ending of the file's name, in upper or lower case. */
MeshFormat mesh_format(const char *path);

/* Number of triangles in a file of `whole` bytes, from the first `size` bytes. Binary STL and PLY state the
   number in the head. Lines of OBJ and text STL are counted within `size`. Returns 0 if unknown. Pure. */
double mesh_count(MeshFormat format, const char *bytes, size_t size, size_t whole);

/* True if the head of a PLY, given in full, has the last line; always true for other formats. assimp would
   search for a missing line forever. Pure. */
bool mesh_has_head(MeshFormat format, const char *bytes, size_t size);

/* True if an STL of `whole` bytes is binary, whatever the first words are. */
bool mesh_is_binary_stl(const char *bytes, size_t size, size_t whole);

#endif
