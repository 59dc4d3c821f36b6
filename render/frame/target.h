/* The off-screen framebuffer that a picture is drawn into.

   Colour is 8-bit sRGB: shaders write linear light and the framebuffer encodes. Depth is 32-bit float and
   reversed: 1 at the near plane, 0 at infinity. */
#ifndef SLOSH_TARGET_H
#define SLOSH_TARGET_H

#include "sim/base/error.h"

#include <stdint.h>

typedef struct Target {
    int width, height;
    unsigned number; /* each target's own: names of textures come again */
    unsigned framebuffer;
    unsigned color; /* texture, SRGB8_ALPHA8 */
    unsigned depth; /* texture, DEPTH_COMPONENT32F */
} Target;

bool target_create(Target *target, int width, int height, Error *error);
void target_destroy(Target *target);

/* Binds it, clears its depth (its colour is what the backdrop will fill), and sets the depth convention for
   all that is drawn from now on. */
void target_begin(const Target *target);

/* 3 * width * height bytes, rows from the top down; waits for the drawing. */
void target_read(const Target *target, uint8_t *rgb);

/* Copies the colour as it is into the default framebuffer, its lower left corner at x, y, and leaves that one
   bound. */
void target_present(const Target *target, int x, int y);

/* width * height depths, rows from the bottom up; for tests and for picking. */
void target_read_depth(const Target *target, float *depth);

#endif
