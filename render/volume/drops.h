/* Particles that the level surface leaves out: where the field stays below the level, particles are drawn
   as balls of their own volume. Reads the volume's field, the particles and the background; writes the
   target's colour and depth. */
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

/* `defines`: lines of SOLIDS and WATER, as in raycasting. */
bool volume_drops_create(VolumeDrops *drops, const ViewDef *def, const char *defines, Error *error);
void volume_drops_destroy(VolumeDrops *drops); /* a zeroed struct is allowed */

/* The blocks of volume and raycasting must be bound; for water also the background. */
void volume_drops_draw(VolumeDrops *drops, const ParticleBuffers *particles, const Frame *frame);

#endif
