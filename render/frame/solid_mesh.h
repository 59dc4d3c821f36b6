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
    uint32_t solid;    /* number of the vertex's solid */
} SolidVertex;

/* Mesh of any number of solids; zero-initialise. Front faces are counter-clockwise seen from outside. */
typedef struct SolidMesh {
    SolidVertex *vertices;
    uint32_t *indices; /* three per triangle */
    size_t vertex_count, index_count, vertex_room, index_room;
} SolidMesh;

/* Adds a solid. `slab` > 0: depth of a flat box, m. The solid is then its section with the plane, extruded
   along z; a cylinder has no such form and stays a cylinder. Returns false if memory is short; the mesh is
   then unusable. */
bool solid_mesh_add(SolidMesh *mesh, const SolidDef *solid, double slab, uint32_t number);

/* Makes room for more vertices and indices. Returns false if memory is short. */
bool solid_mesh_room(SolidMesh *mesh, size_t vertices, size_t indices);

/* Adds the triangles of a mesh file, smooth except at sharp edges; adds nothing for a missing mesh.
   Returns false if memory is short. */
bool solid_mesh_add_file(SolidMesh *mesh, const MeshUse *use, uint32_t number);

void solid_mesh_destroy(SolidMesh *mesh);

/* True if both solids have the same mesh. */
bool solid_mesh_same(const SolidDef *a, const SolidDef *b);

#endif
