/* Solids: lit and opaque, before every view, so that each view's own test of depth does the rest. Reads the
   def's solids at the state's time; writes the target's colour and depth, and the solids' shadow map; owns
   meshes and poses. Only a scene with solids has one. */
#ifndef SLOSH_SOLIDS_H
#define SLOSH_SOLIDS_H

#include "render/frame/frame.h"
#include "sim/base/error.h"
#include "sim/gl/particle_buffers.h"

typedef struct Solids Solids;

Solids *solids_create(Error *error); /* NULL on failure */
void solids_destroy(Solids *solids); /* NULL is allowed */

/* From the frame of the scene's solid of that number to the world, at the state's time. */
void solid_to_world(const SolidDef *solid, int number, const ParticleBuffers *particles, const Frame *frame,
                    float to_world[16]);

/* Takes the poses of the state's time, before the other two. Makes the meshes only where shapes, or the depth
   of a flat box, are not those of the last picture; when memory is short there are none. */
void solids_place(Solids *solids, const ParticleBuffers *particles, const Frame *frame);

/* Into the map of shadow_begin_solids. */
void solids_cast(const Solids *solids);

void solids_draw(const Solids *solids, const Frame *frame);

#endif
