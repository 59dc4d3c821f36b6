/* The walls of the box as mirrors: behind each wall stand the images of the fluid before it, at edges and
   corners the images of images (after Libersky and Petschek, "High strain Lagrangian hydrodynamics", 1993).

   An image has its particle's density, its velocity in the mirror, and its pressure. Where particles carry
   their density it goes on hydrostatically, p' = p + rho0 g.(x' - x); where density is summed
   sim/box/wall_lift.h is for that, and methods that solve for pressure find what fits. |x_i - x_j'| = |x_i' -
   x_j|, so what particle i finds of images is what its own images find of the fluid. Number density with
   images is a function of places alone and the pressures' forces, without the hydrostatic part, its gradient:
   walls keep the energy that pairs keep, in whatever order the fluid is, and pass no shear. Friction with
   images, of walls that let fluid slip, is that with a fluid in the mirror: the stress along the normal, and
   dissipation alone. The hydrostatic part is along the normal of the wall and, in the mean, a function of the
   distance alone: going round gains nothing. */
#ifndef SLOSH_WALL_IMAGES_H
#define SLOSH_WALL_IMAGES_H

#include "sim/box/wall.h"

enum { IMAGES_MAX = 27 };

typedef struct Image {
    float x[3];    /* m */
    float sign[3]; /* of each axis: -1 where it is mirrored, else 1; velocities and forces take the same signs
                    */
} Image;

/* The particle at x (box's frame, m, inside the box), then its images that see fluid within h: how many.
   Where a box is narrower than h, what both walls make of each other's images is left out. */
int wall_images(const Walls *walls, const float x[3], float h, Image image[IMAGES_MAX]);

#endif
