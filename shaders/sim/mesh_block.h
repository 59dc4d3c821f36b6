/* The grids of distances of the solids that are meshes, whose values are in one buffer texture;
   sim/gl/compute/meshes.c fills it. In the unit of a mesh's file: sim/mesh/distance.h. */
#ifndef SLOSH_MESH_BLOCK_H
#define SLOSH_MESH_BLOCK_H

#include "shaders/shared/block.h"
#include "shaders/sim/bindings.h"

BLOCK_STRUCT(MeshGrid)
{
    dvec3 exact_low; /* for who asks for the CPU's bits */
    double exact_cell;
    dvec3 exact_inner;
    double exact_scale;
    vec3 low; /* where the first value stands */
    float cell;
    vec3 inner;  /* the surface is within -inner .. inner */
    float scale; /* m */
    ivec3 size;
    int first; /* its first value among those of all meshes */
}
BLOCK_END(MeshGrid);

UNIFORM_BLOCK(MeshBlock, MESH_BLOCK)
{
    MeshGrid meshes[SOLIDS_MOST];
}
BLOCK_END(MeshBlock);

#endif
