/* Opacity of a surface made of points that cover a pixel each, and back. After: S. Tanaka et al.,
   "Particle-based transparent rendering of implicit surfaces and its application to fused visualization",
   EuroVis 2012, section 3.

   Of n points spread evenly over a piece of surface of area S, whose image has S / s pixels, a pixel gets one
   at least with the probability alpha = 1 - (1 - s / S)^n, eq. 1. A piece that is tilted by theta against the
   image plane has an image of S cos(theta) / s pixels only. */
#ifndef SLOSH_OPACITY_H
#define SLOSH_OPACITY_H

/* The most that points give: an opaque layer has some seven of them a pixel and set. */
#define OPACITY_MOST 0.999

/* alpha, 0 .. 1, of n points (any number, at least 0) on an area of which a pixel is the part s / S, 0 .. 1,
   tilted by theta, 0 .. pi / 2: 1 where its image is a pixel or less and it has a point. */
double opacity_of_points(double n, double part, double theta);

/* n for that alpha, 0 .. 1, where the area is not tilted; alpha counts as OPACITY_MOST at most. */
double points_of_opacity(double alpha, double part);

/* The same for points that fall independently of each other, as for an area of many pixels: how many a m2 in
   one set where a pixel is `pixel` m2 on the surface. Their alpha is exact for any shape of the area:
   1 - exp(-density pixel / cos(theta)). */
double point_density_of_opacity(double alpha, double pixel);

/* How many in all of `sets` sets on an area of A m2. */
double points_of_area(double alpha, double pixel, double area, int sets);

/* s: of a plane parallel to the image plane at `depth` m along the eye's axis what a pixel shows, m2. The
   picture has so many pixels, `tangent` is of half its field of view in x and y. */
double pixel_area(const float tangent[2], int width, int height, double depth);

/* The standard deviation of a pixel's opacity, as the mean of so many sets. */
double opacity_noise(double alpha, int sets);

#endif
