/* Solids: lit and opaque, drawn before every view, so that the view's depth test hides covered parts.
   Reads the def's solids at the state's time; writes the target's colour and depth, and the solids' shadow
   map. Owns meshes and poses. Exists only in scenes with solids. */
#ifndef SLOSH_SOLIDS_H
#define SLOSH_SOLIDS_H

#include "render/frame/frame.h"
#include "sim/base/error.h"
#include "sim/gl/particle_buffers.h"

typedef struct Solids Solids;

Solids *solids_create(Error *error); /* NULL on failure */
void solids_destroy(Solids *solids); /* NULL is allowed */

/* Matrix from the frame of the scene's solid `number` to the world, at the state's time. */
void solid_to_world(const SolidDef *solid, int number, const ParticleBuffers *particles, const Frame *frame,
                    float to_world[16]);

/* Updates the poses for the state's time; call before solids_cast and solids_draw. Makes the meshes again
   only if shapes, or the depth of a flat box, have changed. If memory is short, there are no meshes. */
void solids_place(Solids *solids, const ParticleBuffers *particles, const Frame *frame);

/* Draws into the map of shadow_begin_solids. */
void solids_cast(const Solids *solids);

void solids_draw(const Solids *solids, const Frame *frame);

#endif
