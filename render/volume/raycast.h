/* Raycasting of a volume. Rays start and end at rasterised faces, of the volume or of its occupied bricks,
   and march from front to back. After: "SPH coupled with volume rendering", SIBGRAPI 2010, section IV.B;
   Krüger and Westermann 2003.

   Reads the volume, the target's depth and the shadow maps; writes the target's colour and depth; owns the
   depths where rays enter and leave. Needs the frame's uniform block and a current OpenGL 4.5 core
   context. */
#ifndef SLOSH_RAYCAST_H
#define SLOSH_RAYCAST_H

#include "render/frame/frame.h"
#include "render/volume/volume.h"
#include "sim/base/error.h"

typedef struct Raycast Raycast;

/* For volumes of `voxelizer`; NULL: for textures of the field alone. Returns NULL if a shader does not
   compile or the colormap is unknown. */
Raycast *raycast_create(const Subject *subject, const Voxelizer *voxelizer, Error *error);
void raycast_destroy(Raycast *raycast); /* NULL is allowed */

/* True except in a draft. A draft leaves out edges behind water and the line where water meets glass, and
   needs another program. */
bool raycast_is_whole(const ViewDef *def);

/* True if the transfer function's curve is not the plain ramp; needs another program. */
bool raycast_is_curved(const ViewDef *def);

/* Draws into frame->target, within the stage `raycast`. Call after target_begin; solids must be in the
   target's depth. `particles`: the state that `volume` was made from. */
void raycast_draw(Raycast *raycast, const Volume *volume, const Voxelizer *voxelizer,
                  const ParticleBuffers *particles, const Frame *frame);

/* The maps of the last drawing, for tests: reversed depths per pixel; without a face, 0 in `entry` and 1
   in `exit`. `greatest` has a texel per brick. */
typedef struct RaycastMaps {
    unsigned entry, exit, greatest;
} RaycastMaps;

RaycastMaps raycast_maps(const Raycast *raycast);

#endif
