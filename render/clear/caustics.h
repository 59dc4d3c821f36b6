/* Light patterns on the floor below clear fluid: the surface focuses light on some places and takes light
   from the rest.

   Modelled: one refraction by Snell's law where light enters, at the first surface that the light meets,
   smoothed over two spacings; the way down as if the fluid reached the floor. Refracted light is not lost:
   the mean of the pattern is 1, and below a flat surface the pattern is 1.

   Not modelled: refraction where light leaves the box; the shift of all light by a flat surface; a second
   surface below the first; light through the box's sides; reflection and absorption (Frame.clear stands
   for both); patterns on solids. Spray, similarly rough surfaces, fluid far above its level at rest, and
   the last spacings before a wall do not refract. */
#ifndef SLOSH_CAUSTICS_H
#define SLOSH_CAUSTICS_H

#include "render/frame/frame.h"
#include "sim/base/error.h"

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

#endif
