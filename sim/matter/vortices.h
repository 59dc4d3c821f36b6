/* The vortices of G. I. Taylor and A. E. Green, "Mechanism of the production of small eddies from large
   ones", 1937, in the plane: an exact solution that decays as exp(-nu (kx^2 + ky^2) t), kx = 2 pi / width, ky
   = 2 pi / height,

     u = -U cos(kx x) sin(ky y),  v = U (kx / ky) sin(kx x) cos(ky y),
     p = -rho U^2 / 4 (cos(2 kx x) + (kx / ky)^2 cos(2 ky y)),

   in the box's frame, two by two of them in the box. */
#ifndef SLOSH_VORTICES_H
#define SLOSH_VORTICES_H

#include "sim/matter/world_def.h"

/* Adds those of the fluid to v (m/s) at x (m); returns their pressure, Pa. */
double vortices_add(const WorldDef *def, const FluidDef *fluid, const float x[3], float v[3]);

/* Whether some fluid starts with them. */
bool vortices_any(const WorldDef *def);

#endif
