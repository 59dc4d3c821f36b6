/* A closed mesh as a shape: triangles, distance grid and measures. Positions are relative to the middle of
   the bounding box; lengths are in the file's unit. */
#ifndef SLOSH_MESH_SHAPE_H
#define SLOSH_MESH_SHAPE_H

#include "sim/mesh/distance.h"
#include "sim/mesh/mend.h"

typedef struct MeshShape {
    Triangles triangles;
    DistanceGrid distance;
    double half[3];      /* half the sides of the bounding box */
    double reach;        /* from the middle to the farthest vertex */
    double volume, area; /* volume: of the union of the parts; area: of the triangles */
    Moments excess;      /* integrals over the triangles less integrals over the union; 0 without overlaps */
    double depth;        /* from the surface to the place deepest inside */
    uint64_t hash;       /* of the vertices and triangles */
} MeshShape;

/* Faults of an accepted mesh. Parts overlap if the shape's excess is not 0. */
typedef struct MeshState {
    TrianglesState triangles;
    double middle[3];   /* of the bounding box, before the move to 0 */
    size_t cutting;     /* intersecting pairs of triangles */
    bool all_looked_at; /* all pairs were tested; false: there may be more */
    char coarse[200];   /* message for the user if the file's floats are too coarse so far from 0; "": fine
                           enough */
} MeshState;

/* Makes a shape; free with mesh_shape_free. Takes ownership of the triangles: `triangles` is empty on return.
   Returns NULL if the mesh encloses nothing, is open, memory is short, or `stop` (may be NULL) is wanted;
   `error` says "what is wrong; what would be right". Millions of long triangles that cut each other take
   hours. */
MeshShape *mesh_shape_make(Triangles *triangles, int threads, const Stop *stop, MeshState *state,
                           Error *error);
void mesh_shape_free(MeshShape *shape); /* NULL is allowed */

#endif
