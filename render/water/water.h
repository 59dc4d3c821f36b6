/* Effects around clear fluid: light patterns on the floor, foam, and the panes of a glass box. A renderer
   creates an effect for the first picture that shows the effect. Needs a current OpenGL 4.5 core context. */
#ifndef RENDER_WATER_WATER_H
#define RENDER_WATER_WATER_H

#include "render/frame/frame.h"
#include "slosh/error.h"

/* Light patterns on the floor below clear fluid: the surface focuses light on some places and takes light
   from the rest.

   Modelled: one refraction by Snell's law where light enters, at the first surface that the light meets,
   smoothed over two spacings; the way down as if the fluid reached the floor. Refracted light is not lost:
   the mean of the pattern is 1, and below a flat surface the pattern is 1.

   Not modelled: refraction where light leaves the box; the shift of all light by a flat surface; a second
   surface below the first; light through the box's sides; reflection and absorption (Frame.clear stands
   for both); patterns on solids. Spray, similarly rough surfaces, fluid far above its level at rest, and
   the last spacings before a wall do not refract. */

enum { CAUSTIC_HEIGHT, CAUSTIC_SMOOTH, CAUSTIC_FACTOR, CAUSTIC_LIGHT, CAUSTIC_MAPS };

typedef struct Caustics {
    unsigned programs[4], vertex_array; /* 0: not created yet */
    unsigned maps[CAUSTIC_MAPS];        /* textures of CAUSTIC_TEXELS squared over the floor area of
                                           Frame.floor_map_corner: height, fluid fraction around, mean square
                                           deviation, twice; focused light, mean 1; light on the floor (R32F) */
    unsigned framebuffers[CAUSTIC_MAPS];
} Caustics;

/* Returns false if a shader does not compile; call caustics_destroy in either case. Does nothing if
   already created. */
bool caustics_create(Caustics *caustics, Error *error);
void caustics_destroy(Caustics *caustics); /* a zeroed struct is allowed */

/* True if the picture has light patterns: clear fluid over a floor, three dimensions, no draft. */
bool caustics_wanted(const Frame *frame);

/* Call after shadow_end, which binds the fluid's shadow map to unit 0. `shadow_left`: R32F, floor light
   after shadows. Returns the texture of this light with the patterns: for Frame.floor_light. */
unsigned caustics_draw(const Caustics *caustics, const ParticleBuffers *particles, const Frame *frame,
                       unsigned shadow_left);

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

/* The panes of a glass box: faint reflections of sky and floor, by Fresnel's formula. Blends colour; tests
   depth but writes none. The edges of the panes: render/frame/passes.h. */

typedef struct Glass {
    unsigned program; /* 0: not created yet */
    unsigned vertex_array;
} Glass;

/* Returns false if a shader does not compile. Does nothing if already created. */
bool glass_create(Glass *glass, Error *error);
void glass_destroy(Glass *glass); /* a zeroed struct is allowed */

/* `behind`: draws the panes that face away from the eye (call before drawing the box's contents); else the
   panes that face the eye (call after). */
void glass_draw(const Glass *glass, const Frame *frame, bool behind);

#endif
