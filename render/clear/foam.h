/* Foam on clear fluid: white bubbles where it breaks up. After: Ihmsen, Akinci, Akinci and Teschner, Unified
   spray, foam and bubbles for particle-based fluids, 2012.

   A particle foams where it traps air (SCALAR_TRAPPED_AIR) and is fast, each clamped as there between two
   speeds; then up to FOAM_BUBBLES bubbles are around it, at places that its id keeps. Other than there no
   bubble has a life of its own: foam is what the state makes it, so that a step back, a replay and a file all
   show the same. So it does not outlive what stirred it up.

   Bubbles lie on the surface that the view left in the target's depth and, fainter, a little below. They
   write no depth, cast no shadow, and are light only where light comes. At most FOAM_MOST are drawn, or one a
   particle where more than that foam. */
#ifndef SLOSH_FOAM_H
#define SLOSH_FOAM_H

#include "render/frame/frame.h"
#include "sim/base/error.h"

enum { FOAM_MOST = 200000 };

/* All zero at first. */
typedef struct Foam {
    unsigned list, draw[2]; /* programs; draw: without and with solids */
    unsigned vertex_array;
    unsigned listed, command; /* buffers */
    size_t capacity;          /* of listed, particles */
    unsigned surface, solid;  /* textures: copies of the target's depth */
    unsigned target_number;   /* of the target whose size they have */
} Foam;

/* False when a shader does not compile; foam_destroy is needed in either case. Nothing is done where it is
   made already. */
bool foam_create(Foam *foam, Error *error);
void foam_destroy(Foam *foam);

/* Adds what foam is made of, but for the trapped air, of which it needs that of fast particles only. */
void foam_want(ParticleWants *wants);

/* The speed below which a particle does not foam, m/s. */
double foam_slowest(const ViewDef *def);

/* Before the view draws: keeps the depth of solids, where there are some. */
void foam_begin(Foam *foam, const Frame *frame);

/* Behind the view: draws over the target's colour. `air`: SCALAR_TRAPPED_AIR of particles that are not slower
   than foam_slowest. Draws nothing where the state lacks what foam is made of. */
void foam_draw(Foam *foam, const ParticleBuffers *state, const ParticleAttribute *air, const Frame *frame);

#endif
