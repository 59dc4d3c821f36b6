/* Solids as closed triangle meshes with normals: smooth along their curves, crisp at their edges. */
#ifndef SLOSH_SOLID_MESH_H
#define SLOSH_SOLID_MESH_H

#include "sim/matter/solid.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct SolidVertex {
    float position[3]; /* in the solid's own frame, m */
    float normal[3];   /* unit, outwards */
    uint32_t solid;    /* number of the solid that it belongs to */
} SolidVertex;

/* Of any number of solids; zero-initialise it. Front faces are counter-clockwise seen from outside. */
typedef struct SolidMesh {
    SolidVertex *vertices;
    uint32_t *indices; /* three a triangle */
    size_t vertex_count, index_count, vertex_room, index_room;
} SolidMesh;

/* Adds a solid. `slab` > 0 is the depth of a flat box, m: the solid is then what it is in the plane, extruded
   along z; a cylinder has no such form and stays one. False, and the mesh unusable, when memory is short. */
bool solid_mesh_add(SolidMesh *mesh, const SolidDef *solid, double slab, uint32_t number);

/* Room for more; false when memory is short. */
bool solid_mesh_room(SolidMesh *mesh, size_t vertices, size_t indices);

/* Adds the triangles of a mesh from a file, which are smooth but where its faces meet at an edge; of one that
   is gone, nothing. */
bool solid_mesh_add_file(SolidMesh *mesh, const MeshUse *use, uint32_t number);

void solid_mesh_destroy(SolidMesh *mesh);

/* Whether both have the same mesh. */
bool solid_mesh_same(const SolidDef *a, const SolidDef *b);

#endif
