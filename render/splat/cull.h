/* Finds the particles whose sprites may be seen, before any is drawn: hidden ones lie behind a coarse map of
   what is covered (shaders/splat/cull.glsl). What is left is listed in the particles' order, and drawn
   indirectly: nothing comes back to this side.

   Nothing that would change a pixel is left out. */
#ifndef SLOSH_CULL_H
#define SLOSH_CULL_H

#include "render/frame/frame.h"
#include "sim/base/error.h"
#include "sim/gl/particle_buffers.h"

#include <stdbool.h>
#include <stddef.h>

/* NEAREST: may be the nearest in some pixel; BLEND: may be within eps of it. */
typedef enum CullList { CULL_NEAREST, CULL_BLEND, CULL_LISTS } CullList;

typedef struct Cull {
    unsigned occlude, test, sum, list; /* programs */
    unsigned limit;                    /* program, after cull_create_limit */
    unsigned map, rows;                /* buffer: a depth a cell; texture: the same, four at once */
    unsigned marks;          /* buffer of FluidTiles: those that listed particles touch are marked */
    unsigned kept, commands; /* see cull_test.comp, cull_sum.comp */
    unsigned lists[CULL_LISTS];
    size_t cells, capacity; /* how many `map` has room for; how many particles `lists` have room for */
} Cull;

/* For particles as splat/splat_body.glsl has them with these defines. False when a shader does not
 * compile; cull_destroy is needed in either case. */
bool cull_create(Cull *cull, const char *body, Error *error);
void cull_destroy(Cull *cull);

/* Both lists for the picture, of the hidden particles with `hidden`; `eps` in m, `vertices` drawn for a
 * particle. */
void cull_for_eye(Cull *cull, const ParticleBuffers *particles, const Frame *frame, float eps,
                  unsigned vertices, bool hidden);

/* For cull_to_limit: false when its shader does not compile. */
bool cull_create_limit(Cull *cull, Error *error);

/* Both lists: the particles whose sprites reach before what a depth map as large as the picture has at some
   pixel; `limit` is reversed, 0 lets all through, 1 nothing. */
void cull_to_limit(Cull *cull, const ParticleBuffers *particles, const Frame *frame, unsigned limit,
                   unsigned vertices);

/* Binds a list for shaders with LISTED. The command for its drawing stands in cull->commands, at the offset
   that comes back. */
size_t cull_use(const Cull *cull, CullList list);

#endif
