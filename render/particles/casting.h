/* Particle shadows: drawn by a view between shadow_begin and shadow_end (render/frame/shadow.h). */
#ifndef SLOSH_CASTING_H
#define SLOSH_CASTING_H

#include "sim/base/error.h"
#include "sim/gl/particle_buffers.h"

#include <stdbool.h>

typedef struct Casting {
    unsigned write, show; /* programs */
    unsigned texels;      /* buffer: one depth per texel of the shadow map */
    unsigned rows;        /* texture: `texels`, four per fetch */
    unsigned screen;      /* vertex array without attributes */
} Casting;

/* `defines`: of shaders/common/ball.glsl for the balls, or NULL. Returns false if a shader does not
   compile; call casting_destroy in either case. */
bool casting_create(Casting *casting, const char *defines, Error *error);
void casting_destroy(Casting *casting);

/* Draws the shadows. The bits do not depend on the order of the particles. */
void casting_draw(const Casting *casting, const ParticleBuffers *particles);

#endif
