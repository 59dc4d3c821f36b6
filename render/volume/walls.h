/* The walls of the box in a volume: fluid at a wall reaches it, as if its mirror image stood behind. Changes
   the volume's textures in place, whichever method made them; a field that is summed at the sample has none.
 */
#ifndef SLOSH_VOLUME_WALLS_H
#define SLOSH_VOLUME_WALLS_H

#include "render/volume/volume.h"

#include <stdbool.h>

typedef struct VolumeWalls {
    unsigned program;
} VolumeWalls;

bool volume_walls_create(VolumeWalls *walls, Error *error);
void volume_walls_destroy(VolumeWalls *walls); /* zeroed is allowed */

/* At the sides of the box that are walls: not those of a periodic axis, nor front and back of a scene of two
   dimensions. Says in the volume which axes have them. */
void volume_walls_mirror(const VolumeWalls *walls, const ParticleBuffers *particles, const bool periodic[3],
                         Volume *volume);

#endif
