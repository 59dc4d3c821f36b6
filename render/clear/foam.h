/* Foam on clear fluid: white bubbles where the surface breaks. After: Ihmsen, Akinci, Akinci and Teschner,
   Unified spray, foam and bubbles for particle-based fluids, 2012.

   A particle foams if the particle traps air (SCALAR_TRAPPED_AIR) and is fast; both measures are clamped
   between two speeds, as in the paper. Up to FOAM_BUBBLES bubbles surround such a particle, at offsets
   fixed by the particle's id. Unlike the paper, bubbles have no life of their own: foam depends on the
   state alone, so a step back, a replay and a file show the same foam. Hence foam ends as soon as the
   motion that made the foam does.

   Bubbles lie on the surface in the target's depth and, fainter, a little below. Bubbles write no depth,
   cast no shadow, and are lit only where light arrives. At most FOAM_MOST bubbles are drawn, or one per
   particle if more particles foam. */
#ifndef SLOSH_FOAM_H
#define SLOSH_FOAM_H

#include "render/frame/frame.h"
#include "sim/base/error.h"

enum { FOAM_MOST = 200000 };

/* Zero-initialise. */
typedef struct Foam {
    unsigned list, draw[2]; /* programs; draw: without and with solids */
    unsigned vertex_array;
    unsigned listed, command; /* buffers */
    size_t capacity;          /* capacity of `listed`, particles */
    unsigned surface, solid;  /* textures: copies of the target's depth */
    unsigned target_number;   /* number of the target that gave the textures their size */
} Foam;

/* Returns false if a shader does not compile; call foam_destroy in either case. Does nothing if already
   created. */
bool foam_create(Foam *foam, Error *error);
void foam_destroy(Foam *foam);

/* Adds the particle data that foam reads, except the trapped air: foam needs air of fast particles only. */
void foam_want(ParticleWants *wants);

/* The least speed of particles that foam, m/s. */
double foam_slowest(const ViewDef *def);

/* Call before the view draws: keeps the depth of solids, if any. */
void foam_begin(Foam *foam, const Frame *frame);

/* Call after the view: draws over the target's colour. `air`: SCALAR_TRAPPED_AIR of particles with at
   least the speed foam_slowest. Draws nothing if the state lacks the inputs. */
void foam_draw(Foam *foam, const ParticleBuffers *state, const ParticleAttribute *air, const Frame *frame);

#endif
