/* How far a picture is from a reference picture: pure functions of linear light. */
#ifndef SLOSH_PICTURE_ERROR_H
#define SLOSH_PICTURE_ERROR_H

#include <stdbool.h>
#include <stdint.h>

typedef struct LinearPicture {
    int width, height;
    float *rgb; /* 3 * width * height, linear light, 1 is white; owned */
} LinearPicture;

/* The mean of `factor` x `factor` pixels of sRGB each, taken in linear light: from 3 * factor * width *
   factor * height bytes. False without memory. */
bool linear_picture_make(LinearPicture *picture, const uint8_t *srgb, int width, int height, int factor);
void linear_picture_free(LinearPicture *picture);

/* The root of the mean square of the difference, over all pixels and the three colours; a fraction of white.
   Both are of one size, here and below. */
double picture_rms(const LinearPicture *a, const LinearPicture *b);

/* 1 - SSIM, the mean over blocks of 8 x 8 pixels of luma: 0 where structures are the same, 1 where they have
   nothing in common. After: Wang, Bovik, Sheikh and Simoncelli, "Image quality assessment", 2004, with its
   K1 = 0.01, K2 = 0.03, and blocks in place of its sliding window. */
double picture_structure(const LinearPicture *a, const LinearPicture *b);

#endif
