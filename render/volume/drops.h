/* What the surface at a level leaves out: particles around which the field does not reach it, as balls of
   their own volume. Reads the volume's field, the particles and what is behind; writes the target's colour
   and depth. */
#ifndef SLOSH_VOLUME_DROPS_H
#define SLOSH_VOLUME_DROPS_H

#include "render/frame/colormap.h"
#include "render/frame/frame.h"
#include "render/particles/particle_bind.h"
#include "sim/base/error.h"

typedef struct VolumeDrops {
    unsigned program;
    ColorTable colors;
    QuadIndices quads;
} VolumeDrops;

/* `defines`: lines of SOLIDS and WATER, as raycasting has them. */
bool volume_drops_create(VolumeDrops *drops, const ViewDef *def, const char *defines, Error *error);
void volume_drops_destroy(VolumeDrops *drops); /* zeroed is allowed */

/* The blocks of volume and raycasting are bound, and of water what is behind. */
void volume_drops_draw(VolumeDrops *drops, const ParticleBuffers *particles, const Frame *frame);

#endif
