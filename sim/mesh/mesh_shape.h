/* A closed mesh as a shape: its triangles, the distance from them, and what it measures. All about the middle
   of the block around it, in the unit of its file. */
#ifndef SLOSH_MESH_SHAPE_H
#define SLOSH_MESH_SHAPE_H

#include "sim/mesh/distance.h"
#include "sim/mesh/mend.h"
#include "sim/mesh/overlap.h"

typedef struct MeshShape {
    Triangles triangles;
    DistanceGrid distance;
    double half[3];      /* half the sides of the block around it */
    double reach;        /* from the middle to the farthest vertex */
    double volume, area; /* volume: of the union of the parts; area: of the triangles */
    Moments excess; /* integrals over the triangles less integrals over the union; 0 where no parts overlap */
    double depth;   /* from the surface to the place deepest inside */
    uint64_t hash;  /* of its triangles */
} MeshShape;

/* What is wrong with a mesh that was made all the same. Parts overlap where the shape's excess is not 0. */
typedef struct MeshState {
    TrianglesState triangles;
    double middle[3];   /* of the block around it, where it came from */
    size_t cutting;     /* pairs of triangles that cut each other */
    bool all_looked_at; /* for such pairs; false: there may be more */
    char coarse[200]; /* a line for the user where the file's numbers are too coarse, so far from 0; "": none
                       */
} MeshState;

/* Takes the triangles over, which are empty then. NULL where they enclose nothing, are open, or memory is
   short: `error` says "what is wrong; what would be right". */
MeshShape *mesh_shape_make(Triangles *triangles, int threads, MeshState *state, Error *error);
void mesh_shape_free(MeshShape *shape); /* NULL is allowed */

#endif
