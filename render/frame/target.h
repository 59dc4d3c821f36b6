/* The off-screen framebuffer of a picture.

   Colour is 8-bit sRGB: shaders write linear light and the framebuffer encodes. Depth is 32-bit float and
   reversed: 1 at the near plane, 0 at infinity. */
#ifndef SLOSH_TARGET_H
#define SLOSH_TARGET_H

#include "sim/base/error.h"

#include <stdint.h>

typedef struct Target {
    int width, height;
    unsigned number; /* unique per target; GL names of textures are reused */
    unsigned framebuffer;
    unsigned color; /* texture, SRGB8_ALPHA8 */
    unsigned depth; /* texture, DEPTH_COMPONENT32F */
} Target;

bool target_create(Target *target, int width, int height, Error *error);
void target_destroy(Target *target);

/* Binds the target, clears its depth (the backdrop will fill the colour), and sets the depth convention
   for all later drawing. */
void target_begin(const Target *target);

/* Reads 3 * width * height bytes, rows from the top down; waits for the GPU. */
void target_read(const Target *target, uint8_t *rgb);

/* Copies the encoded colour into the default framebuffer, lower left corner at x, y, and leaves the
   default framebuffer bound. */
void target_present(const Target *target, int x, int y);

/* Reads width * height depths, rows from the bottom up; for tests and picking. */
void target_read_depth(const Target *target, float *depth);

#endif
