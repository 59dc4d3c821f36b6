/* Solids as voxels: a 3D texture of distances from the surface per solid, in the solid's frame, so that
   moving solids are not voxelised again. Drawn by rays through these textures. Drawn depths match the
   shape within a cell; parts thinner than a cell may be lost.

   Reads the def's solids at the state's time, and the shadow maps; writes the target's colour and depth.
   Needs the frame's uniform block and a current OpenGL 4.5 core context. */
#ifndef SLOSH_SOLID_VOXELS_H
#define SLOSH_SOLID_VOXELS_H

#include "render/frame/frame.h"
#include "sim/base/error.h"

#include <stdbool.h>

typedef struct SolidVoxels SolidVoxels;

SolidVoxels *solid_voxels_create(Error *error); /* NULL if a shader does not compile or memory is short */
void solid_voxels_destroy(SolidVoxels *voxels); /* NULL is allowed */

/* Draws all solids of the frame with cells of side `cell` (m), or longer cells if a solid would have more
   than some four million. Voxelises again only if shapes or the cell have changed. A solid without memory
   is not drawn; solid_voxels_lacks reports this. */
void solid_voxels_draw(SolidVoxels *voxels, double cell, const ParticleBuffers *particles,
                       const Frame *frame);

/* What the last picture lacks, in words of one line; NULL: nothing. */
const char *solid_voxels_lacks(const SolidVoxels *voxels);

/* The corners of a block around the solid in its own frame, m. `slab`: as in render/frame/solid_mesh.h. */
void solid_voxels_bounds(const SolidDef *solid, double slab, double low[3], double high[3]);

#endif
