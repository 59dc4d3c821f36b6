/* Colours: sRGB as people write it, and the linear light that is computed with; 0 .. 1. */
#ifndef SLOSH_COLOR_H
#define SLOSH_COLOR_H

double srgb_to_linear(double value);
double linear_to_srgb(double value);

#endif
