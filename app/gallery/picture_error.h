/* Distance between a picture and a reference picture: pure functions of linear light. */
#ifndef SLOSH_PICTURE_ERROR_H
#define SLOSH_PICTURE_ERROR_H

#include <stdbool.h>
#include <stdint.h>

typedef struct LinearPicture {
    int width, height;
    float *rgb; /* 3 * width * height, linear light, 1 is white; owned */
} LinearPicture;

/* Averages blocks of `factor` x `factor` sRGB pixels in linear light. `srgb` has 3 * factor * width *
   factor * height bytes. Returns false if memory is short. */
bool linear_picture_make(LinearPicture *picture, const uint8_t *srgb, int width, int height, int factor);
void linear_picture_free(LinearPicture *picture);

/* Root mean square of the difference, over all pixels and three colours; a fraction of white. Here and
   below both pictures have the same size. */
double picture_rms(const LinearPicture *a, const LinearPicture *b);

/* 1 - SSIM, mean over blocks of 8 x 8 pixels of luma: 0 for equal structures, 1 for entirely different
   structures. After: Wang, Bovik, Sheikh and Simoncelli, "Image quality assessment", 2004, with its K1 =
   0.01, K2 = 0.03, but blocks in place of its sliding window. */
double picture_structure(const LinearPicture *a, const LinearPicture *b);

#endif
