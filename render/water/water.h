/* Effects around clear fluid: light patterns on the floor, foam, and the panes of a glass box. An effect has
   GL objects from the first picture that shows the effect. */
#ifndef RENDER_WATER_WATER_H
#define RENDER_WATER_WATER_H

#include "render/frame/effect.h"

/* Light patterns on the floor below clear fluid: the surface focuses light on some places and takes light
   from the rest.

   Modelled: one refraction by Snell's law where light enters, at the first surface that the light meets,
   smoothed over two spacings. The way down as if the fluid reached the floor. Refracted light is not lost:
   the mean of the pattern is 1, and below a flat surface the pattern is 1.

   Not modelled: refraction where light leaves the box. The shift of all light by a flat surface. A second
   surface below the first. Light through the box's sides. Reflection and absorption (FrameFluid.clear
   stands for both). Patterns on solids. Spray, similarly rough surfaces, fluid far above its level at rest,
   and the last spacings before a wall do not refract. */

enum { CAUSTIC_HEIGHT, CAUSTIC_SMOOTH, CAUSTIC_FACTOR, CAUSTIC_LIGHT, CAUSTIC_MAPS };

typedef struct Caustics {
    unsigned programs[4], vertex_array; /* 0: not created yet */
    unsigned maps[CAUSTIC_MAPS];        /* textures of CAUSTIC_TEXELS squared over the floor area of
                                           Frame.floor.map_corner: height, fluid fraction around, mean square
                                           deviation, twice; focused light, mean 1; light on the floor (R32F) */
    unsigned framebuffers[CAUSTIC_MAPS];
} Caustics;

/* Returns false if a shader does not compile; call caustics_destroy in either case. Does nothing if
   already created. */
bool caustics_create(Caustics *caustics, Error *error);
void caustics_destroy(void *state); /* a Caustics; a zeroed one is allowed */

/* Reads the fluid's shadow map at its texture unit and the floor light after shadows, Frame.floor.light.
   Returns the texture of this light with the patterns. */
unsigned caustics_draw(const Caustics *caustics, const ParticleBuffers *particles, const Frame *frame);

/* Clear fluid over a floor, three dimensions, no draft. After effect_shadow. */
extern const Effect effect_caustics;

/* Foam on clear fluid: white bubbles where the surface breaks. After: Ihmsen, Akinci, Akinci and Teschner,
   Unified spray, foam and bubbles for particle-based fluids, 2012.

   A particle foams if the flow around it is turbulent (derived_foam) and if it is fast; both measures are
   clamped between two speeds, as in the paper. The paper's trapped air is left out: a dam that falls smoothly
   has it too. Up to FOAM_BUBBLES bubbles surround such a particle, at offsets
   fixed by the particle's id. Unlike the paper, bubbles are not advected on their own: foam moves with the
   particle, and of a picture's foam exp(-t / FOAM_LIFE) is left after a time t of the simulation. So a
   picture's foam depends on the pictures before. The first picture, and one that is earlier than the picture
   before, have only the foam that their own state makes.

   A soft patch joins a particle's bubbles. Both lie on the surface in the target's depth and, fainter, a
   little beside. They write no depth, cast no shadow, and are lit only where light arrives. At most FOAM_MOST
   bubbles are drawn, or one per particle if more particles foam. */

enum { FOAM_MOST = 200000 };

#define FOAM_LIFE 1.0 /* s */

/* Before the view: keeps the depth of solids. After the view: draws over the target's colour. */
extern const Effect effect_foam_solids, effect_foam;

/* The panes of a glass box: faint reflections of sky and floor, by Fresnel's formula. The panes behind the
   box's contents, and those before. The edges of the panes: effect_edges. */
extern const Effect effect_glass_behind, effect_glass;

#endif
