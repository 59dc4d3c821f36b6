/* The vortices of G. I. Taylor and A. E. Green, "Mechanism of the production of small eddies from large
   ones", 1937, in the plane: an exact solution, decaying as exp(-nu (kx^2 + ky^2) t), kx = 2 pi / width, ky =
   2 pi / height,

     u = -U cos(kx x) sin(ky y),  v = U (kx / ky) sin(kx x) cos(ky y),
     p = -rho U^2 / 4 (cos(2 kx x) + (kx / ky)^2 cos(2 ky y)),

   in the box's frame, two by two vortices in the box. */
#ifndef SLOSH_VORTICES_H
#define SLOSH_VORTICES_H

#include "sim/matter/world_def.h"

/* Adds the velocity of the fluid's vortices at x (m) to v (m/s); returns their pressure, Pa. */
double vortices_add(const WorldDef *def, const FluidDef *fluid, const float x[3], float v[3]);

/* True if some fluid starts with vortices. */
bool vortices_any(const WorldDef *def);

#endif
