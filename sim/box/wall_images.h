/* The walls of the box as mirrors: images of the fluid behind each wall; at edges and corners, images of
   images (after Libersky and Petschek, "High strain Lagrangian hydrodynamics", 1993).

   An image has its particle's density, the mirrored velocity, and the particle's pressure. With carried
   density the pressure continues hydrostatically, p' = p + rho0 g.(x' - x). With summed density
   sim/box/wall_lift.h replaces this term, and methods that solve for pressure find a matching pressure.

   |x_i - x_j'| = |x_i' - x_j|: the sum of particle i over images equals the sum of its own images over the
   fluid. Number density with images is a function of positions alone, and the pressure forces without the
   hydrostatic part are its gradient. So walls conserve energy as pairs do, for any arrangement of the
   fluid, and transmit no shear. Friction with images, for slip walls, is friction with mirrored fluid:
   stress along the normal, pure dissipation. The hydrostatic part is along the wall's normal and, on
   average, a function of distance alone: a closed path gains no energy. */
#ifndef SLOSH_WALL_IMAGES_H
#define SLOSH_WALL_IMAGES_H

#include "sim/box/wall.h"

enum { IMAGES_MAX = 27 };

typedef struct Image {
    float x[3];    /* m */
    float sign[3]; /* per axis: -1 if mirrored, else 1; for velocities and forces too */
} Image;

/* Writes the particle at x (box's frame, m, inside the box), then its images that see fluid within h.
   Returns the number of entries. In a box narrower than h, mutual images of opposite walls are left out. */
int wall_images(const Walls *walls, const float x[3], float h, Image image[IMAGES_MAX]);

#endif
