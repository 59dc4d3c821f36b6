/* Opacity of a surface of points that cover a pixel each, and the inverse. After: S. Tanaka et al.,
   "Particle-based transparent rendering of implicit surfaces and its application to fused visualization",
   EuroVis 2012, section 3.

   For n points spread evenly over a piece of surface of area S, whose image has S / s pixels, a pixel gets
   at least one point with the probability alpha = 1 - (1 - s / S)^n, eq. 1. A piece tilted by theta
   against the image plane has an image of only S cos(theta) / s pixels. */
#ifndef SLOSH_OPACITY_H
#define SLOSH_OPACITY_H

/* The largest opacity of points: an opaque layer has some seven points per pixel and set. */
#define OPACITY_MOST 0.999

/* alpha, 0 .. 1, of n points (any number, at least 0) on an area tilted by theta, 0 .. pi / 2; a pixel is
   the fraction s / S, 0 .. 1, of the area. 1 if the image is at most a pixel and has a point. */
double opacity_of_points(double n, double part, double theta);

/* n for alpha, 0 .. 1, on an area without tilt; alpha is limited to OPACITY_MOST. */
double points_of_opacity(double alpha, double part);

/* As points_of_opacity, for independent points, as on an area of many pixels: points per m2 in one set if
   a pixel is `pixel` m2 on the surface. alpha is exact for any shape of the area: 1 - exp(-density pixel /
   cos(theta)). */
double point_density_of_opacity(double alpha, double pixel);

/* Number of points in all of `sets` sets on an area of A m2. */
double points_of_area(double alpha, double pixel, double area, int sets);

/* s: the area of a plane parallel to the image plane, at `depth` m along the eye's axis, that a pixel
   shows, m2. `tangent`: of half the field of view in x and y; width and height in pixels. */
double pixel_area(const float tangent[2], int width, int height, double depth);

/* The standard deviation of a pixel's opacity, as the mean of `sets` sets. */
double opacity_noise(double alpha, int sets);

#endif
