/* Solids as voxels: the distance from each one's surface in a 3D texture of its own, in the solid's frame, so
   that one that moves is not voxelised again; drawn by rays through these. Their depth is that of the shape
   within a cell, and parts thinner than a cell may be lost.

   Reads the def's solids at the state's time, and the shadow maps; writes the target's colour and depth.
   Needs the frame's uniform block and a current OpenGL 4.5 core context. */
#ifndef SLOSH_SOLID_VOXELS_H
#define SLOSH_SOLID_VOXELS_H

#include "render/frame/frame.h"
#include "sim/base/error.h"

#include <stdbool.h>

typedef struct SolidVoxels SolidVoxels;

SolidVoxels *solid_voxels_create(Error *error); /* NULL when a shader does not compile or memory is short */
void solid_voxels_destroy(SolidVoxels *voxels); /* NULL is allowed */

/* All solids of the frame, with cells of that side (m), or longer ones where a solid would have more than
   some four million of them. They are voxelised where their shapes or the cell are not those of the last
   picture; one that memory is short for is not drawn, which solid_voxels_lacks says. */
void solid_voxels_draw(SolidVoxels *voxels, double cell, const ParticleBuffers *particles,
                       const Frame *frame);

/* What the last picture lacks, words of one line; NULL: nothing. */
const char *solid_voxels_lacks(const SolidVoxels *voxels);

/* The corners of a block that holds the solid in its own frame, m. `slab`: as in render/frame/solid_mesh.h.
 */
void solid_voxels_bounds(const SolidDef *solid, double slab, double low[3], double high[3]);

#endif
