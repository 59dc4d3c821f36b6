/* Finds the particles whose sprites may be visible, before drawing: hidden sprites are behind a coarse map
   of covered depths (shaders/splat/cull.glsl). The rest is listed in the particles' order and drawn
   indirectly, without reading back to the CPU.

   Culling never changes a pixel. */
#ifndef SLOSH_CULL_H
#define SLOSH_CULL_H

#include "render/frame/frame.h"
#include "sim/base/error.h"
#include "sim/gl/particle_buffers.h"

#include <stdbool.h>
#include <stddef.h>

/* NEAREST: may be the nearest sphere in some pixel; BLEND: may be within eps of the nearest. */
typedef enum CullList { CULL_NEAREST, CULL_BLEND, CULL_LISTS } CullList;

typedef struct Cull {
    unsigned occlude, test, sum, list; /* programs */
    unsigned limit;                    /* program, made by cull_create_limit */
    unsigned map, rows;                /* buffer: a depth per cell; texture: `map`, four per fetch */
    unsigned marks;          /* buffer of FluidTiles: tiles that listed particles touch are marked */
    unsigned kept, commands; /* see cull_test.comp, cull_sum.comp */
    unsigned lists[CULL_LISTS];
    size_t cells, capacity; /* capacity of `map` in cells; capacity of `lists` in particles */
} Cull;

/* `body`: defines of splat/splat_body.glsl for the particles' shape. Returns false if a shader does not
   compile; call cull_destroy in either case. */
bool cull_create(Cull *cull, const char *body, Error *error);
void cull_destroy(Cull *cull);

/* Makes both lists for the picture; `hidden`: lists of the hidden particles instead. `eps` in m;
   `vertices` per particle. */
void cull_for_eye(Cull *cull, const ParticleBuffers *particles, const Frame *frame, float eps,
                  unsigned vertices, bool hidden);

/* Needed for cull_to_limit. Returns false if the shader does not compile. */
bool cull_create_limit(Cull *cull, Error *error);

/* Makes both lists: particles whose sprites are in front of the depth map `limit` at some pixel. `limit`
   has the picture's size and reversed depths: 0 lets everything through, 1 nothing. */
void cull_to_limit(Cull *cull, const ParticleBuffers *particles, const Frame *frame, unsigned limit,
                   unsigned vertices);

/* Binds a list for shaders with LISTED. Returns the offset in cull->commands of the drawing command. */
size_t cull_use(const Cull *cull, CullList list);

#endif
