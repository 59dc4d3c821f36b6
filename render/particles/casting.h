/* The particles' shadows: what a view casts between shadow_begin and shadow_end (render/frame/shadow.h). */
#ifndef SLOSH_CASTING_H
#define SLOSH_CASTING_H

#include "sim/base/error.h"
#include "sim/gl/particle_buffers.h"

#include <stdbool.h>

typedef struct Casting {
    unsigned write, show; /* programs */
    unsigned texels;      /* buffer: a depth for each of the shadow map */
    unsigned rows;        /* texture: `texels`, four at once */
    unsigned screen;      /* vertex array without attributes */
} Casting;

/* For balls as shaders/common/ball.glsl has them with these defines, or NULL. False when a shader does not
   compile; casting_destroy is needed in either case. */
bool casting_create(Casting *casting, const char *defines, Error *error);
void casting_destroy(Casting *casting);

/* The same bits whatever the order of the particles. */
void casting_draw(const Casting *casting, const ParticleBuffers *particles);

#endif
