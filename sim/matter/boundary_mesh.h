/* Boundary particles of a mesh: layers at half a spacing, one and a half ... behind its surface, as
   sim/matter/ boundary.h has them. Those of a layer are thrown on it at random, no nearer to each other than
   lets as many stand there as its area asks for, and then push each other apart. Where a part is too thin for
   a layer, they stand in its middle. */
#ifndef SLOSH_BOUNDARY_MESH_H
#define SLOSH_BOUNDARY_MESH_H

#include "sim/matter/solid.h"

#include <stddef.h>

/* Three floats each, in the solid's frame, m, for the caller to free; NULL when memory is short. The same in
   each run. */
float *boundary_mesh_layers(const MeshUse *mesh, double spacing, double depth, size_t *count);

#endif
