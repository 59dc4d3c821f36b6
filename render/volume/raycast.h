/* Raycasting of a volume: rays start and end at rasterised faces, of the volume or of those bricks of it that
   hold something, and are marched through from front to back. After: "SPH coupled with volume rendering",
   SIBGRAPI 2010, section IV.B; Krüger and Westermann 2003.

   Reads the volume, the target's depth and the shadow maps; writes the target's colour and depth; owns the
   depths at which rays enter and leave. Needs the frame's uniform block, a current OpenGL 4.5 core context.
 */
#ifndef SLOSH_RAYCAST_H
#define SLOSH_RAYCAST_H

#include "render/frame/frame.h"
#include "render/volume/volume.h"
#include "sim/base/error.h"

typedef struct Raycast Raycast;

/* For volumes of that voxelizer; NULL: for textures of the field alone. NULL when a shader does not compile
   or the colormap is unknown. */
Raycast *raycast_create(const Subject *subject, const Voxelizer *voxelizer, Error *error);
void raycast_destroy(Raycast *raycast); /* NULL is allowed */

/* Not in a draft, which leaves out edges behind water and the line where it meets glass: another program. */
bool raycast_is_whole(const ViewDef *def);

/* Whether the transfer function has another curve than its ramp: another program. */
bool raycast_is_curved(const ViewDef *def);

/* Draws into frame->target, within the stage `raycast`. Not before target_begin, and the solids are in the
   target's depth. `particles` tells of spacing only. */
void raycast_draw(Raycast *raycast, const Volume *volume, const Voxelizer *voxelizer,
                  const ParticleBuffers *particles, const Frame *frame);

/* The maps of the last drawing, for tests: reversed depths, pixel by pixel; 0 in `entry` and 1 in `exit`
   where no face is. `greatest` has a texel a brick. */
typedef struct RaycastMaps {
    unsigned entry, exit, greatest;
} RaycastMaps;

RaycastMaps raycast_maps(const Raycast *raycast);

#endif
