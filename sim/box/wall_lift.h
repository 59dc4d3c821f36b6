/* Hydrostatic support by a wall whose images have their particles' pressure. The pressure gradient at such
   a wall is 0; in fluid at rest it is rho0 g. If an image at depth y behind the wall had 2 rho0 g y more
   along the normal, the force on a particle at distance d would gain

     -m g lift(d), lift(d) = V0 sum F x_n 2 y, F = -W'(r) / r, x_n = d + y

   over the lattice behind the wall. For even layers and the kernel (1 - r / h)^3 in three dimensions, lift
   is t^5 (3 - 2 t), t = 1 - d / h. This form is used, scaled to be exact for the first lattice layer; the
   error for further layers is at most 0.02 of a weight. As a function of distance alone, lift is the
   gradient of an energy and heats nothing. Along the wall there is no such part: images of falling
   particles fall too. */
#ifndef SLOSH_WALL_LIFT_H
#define SLOSH_WALL_LIFT_H

#include "sim/box/wall.h"
#include "sim/kernel/lattice.h"

typedef struct WallLift {
    float reach; /* h, m */
    float scale; /* lift at the wall itself */
} WallLift;

/* `lattice` must have the pressure kernel. */
WallLift wall_lift_of(const Lattice *lattice, double spacing, double support_radius);

/* Shares of a particle's weight held by the walls, along each axis; x in the box's frame, m. */
void walls_lift(const WallLift *lift, const Walls *walls, const float x[3], float out[3]);

/* Lift of a single wall at distance d, m, as a sum over the lattice. */
double wall_lift_brute(const Lattice *lattice, double spacing, double support_radius, double d);

#endif
