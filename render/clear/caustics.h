/* Light patterns on the floor below clear fluid: its surface gathers light here and leaves less there.

   Modelled: the one bend where light enters, by Snell's law, at the surface that the light meets first,
   smoothed over two spacings; the way down to the floor as if the fluid reached it. Light that is bent is
   lost nowhere: the mean of the pattern is 1, and a flat surface has 1 everywhere.

   Not modelled: the bends where light leaves the box, the shift that a flat surface gives to all light alike,
   a second surface below the first, light through the box's sides, what the fluid mirrors or absorbs on the
   way (Frame.clear stands for that), patterns on solids. Spray, what is as rough, what hangs far above where
   the fluid would lie at rest, and the last spacings before a wall bend nothing. */
#ifndef SLOSH_CAUSTICS_H
#define SLOSH_CAUSTICS_H

#include "render/frame/frame.h"
#include "sim/base/error.h"

enum { CAUSTIC_HEIGHT, CAUSTIC_SMOOTH, CAUSTIC_FACTOR, CAUSTIC_LIGHT, CAUSTIC_MAPS };

typedef struct Caustics {
    unsigned programs[4], vertex_array; /* 0: not made yet */
    unsigned maps[CAUSTIC_MAPS]; /* textures over what Frame.floor_map_corner says, CAUSTIC_TEXELS squared:
                                    height, share of fluid around, mean square off it, twice; light gathered,
                                    1 in the mean; light on the floor (R32F) */
    unsigned framebuffers[CAUSTIC_MAPS];
} Caustics;

/* False when a shader does not compile; caustics_destroy is needed in either case. Nothing is done where they
   are made already. */
bool caustics_create(Caustics *caustics, Error *error);
void caustics_destroy(Caustics *caustics); /* zeroed is allowed */

/* Whether a picture has them: of clear fluid over a floor, in three dimensions, and no draft. */
bool caustics_wanted(const Frame *frame);

/* Behind shadow_end, whose map of the fluid is bound to unit 0. `shadow_left`: R32F, what shadows leave of
   the light on the floor. Returns the texture that has it with the patterns: for
   Frame.floor_light. */
unsigned caustics_draw(const Caustics *caustics, const ParticleBuffers *particles, const Frame *frame,
                       unsigned shadow_left);

#endif
