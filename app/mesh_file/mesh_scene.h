/* A scene of assimp as a single set of triangles. */
#ifndef SLOSH_MESH_SCENE_H
#define SLOSH_MESH_SCENE_H

#include "sim/mesh/triangles.h"

struct aiScene;

/* The block around the scene, by nodes' matrices in double precision. */
typedef struct MeshBounds {
    double low[3], high[3];
    double largest; /* of the numbers by which triangles lie beside each other */
} MeshBounds;

void mesh_scene_bounds(const struct aiScene *scene, MeshBounds *bounds);

/* The triangles of all meshes where nodes put the meshes, less `origin`; triangles of nodes that mirror are
   turned, as glTF asks. False when there are none, or more than TRIANGLES_MAX, or memory is short. */
bool mesh_scene_take(const struct aiScene *scene, const double origin[3], Triangles *triangles, Error *error);

/* "12,000,000 triangles, more than the ..." */
bool mesh_too_many(double count, Error *error);

#endif
