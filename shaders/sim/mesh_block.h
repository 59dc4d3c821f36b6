/* Distance grids of mesh solids; values are in a buffer texture. Filled by sim/gpu/compute/solids.c. In the
   unit of the mesh's file: sim/mesh/mesh_shape.h. */
#ifndef SLOSH_MESH_BLOCK_H
#define SLOSH_MESH_BLOCK_H

#include "shaders/shared/block.h"
#include "shaders/sim/bindings.h"

BLOCK_STRUCT(MeshGrid)
{
    dvec3 exact_low; /* for worlds with the CPU's bits */
    double exact_cell;
    dvec3 exact_inner;
    double exact_scale;
    vec3 low; /* position of the first value */
    float cell;
    vec3 inner;  /* the surface is within -inner .. inner */
    float scale; /* m */
    ivec3 size;
    int first; /* index of the first value among all meshes */
}
BLOCK_END(MeshGrid);

UNIFORM_BLOCK(MeshBlock, MESH_BLOCK)
{
    MeshGrid meshes[SOLIDS_MOST];
}
BLOCK_END(MeshBlock);

#endif
