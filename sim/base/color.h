/* Colours: sRGB as written by people, and linear light for computing; 0 .. 1. */
#ifndef SLOSH_COLOR_H
#define SLOSH_COLOR_H

double srgb_to_linear(double value);
double linear_to_srgb(double value);

#endif
