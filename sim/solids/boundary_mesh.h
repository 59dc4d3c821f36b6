/* Boundary particles of a mesh: layers at 0.5, 1.5, ... spacings behind the surface, as in
   sim/solids/solid.h. Points of a layer are thrown at random, then thinned by a least distance to the
   number that the layer's area needs, and then push each other apart. Where a part is too thin for a layer,
   particles lie in the part's middle. */
#ifndef SIM_SOLIDS_BOUNDARY_MESH_H
#define SIM_SOLIDS_BOUNDARY_MESH_H

#include "slosh/def.h"

#include <stddef.h>

/* Returns 3 floats per particle, in the solid's frame, m, for the caller to free; NULL if memory is short.
   `spacing` and `depth` are in m; *count is the number of particles. Each run gives the same particles. */
float *boundary_mesh_layers(const MeshUse *mesh, double spacing, double depth, size_t *count);

#endif
