/* A scene of assimp as a single set of triangles. */
#ifndef SLOSH_MESH_SCENE_H
#define SLOSH_MESH_SCENE_H

#include "sim/mesh/triangles.h"

struct aiScene;

/* Bounding box of the scene, by the nodes' matrices in double precision. */
typedef struct MeshBounds {
    double low[3], high[3];
    double largest; /* largest coordinate before node offsets; with several meshes, offsets count as well */
} MeshBounds;

void mesh_scene_bounds(const struct aiScene *scene, MeshBounds *bounds);

/* Takes the triangles of all meshes, placed by the nodes, less `origin`; turns triangles of mirroring nodes,
   as glTF asks. The caller frees with triangles_free, also after false. Returns false if there are no
   triangles or more than TRIANGLES_MAX, or memory is short. */
bool mesh_scene_take(const struct aiScene *scene, const double origin[3], Triangles *triangles, Error *error);

/* "12,000,000 triangles, more than the ..." */
bool mesh_too_many(double count, Error *error);

#endif
