/* The walls of the box in a volume: the field extends to a wall, as if a mirror image of the fluid were
   behind. Changes the volume's textures in place, for any method; does nothing for a field that is summed
   at the sample. */
#ifndef SLOSH_VOLUME_WALLS_H
#define SLOSH_VOLUME_WALLS_H

#include "render/volume/volume.h"

#include <stdbool.h>

typedef struct VolumeWalls {
    unsigned program;
} VolumeWalls;

bool volume_walls_create(VolumeWalls *walls, Error *error);
void volume_walls_destroy(VolumeWalls *walls); /* a zeroed struct is allowed */

/* Mirrors at all walls of the box: not at sides of a periodic axis, nor at front and back in two
   dimensions. Sets volume->walled. */
void volume_walls_mirror(const VolumeWalls *walls, const ParticleBuffers *particles, const bool periodic[3],
                         Volume *volume);

#endif
