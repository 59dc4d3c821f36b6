/* What rests on a wall whose images have their particles' pressure. The slope of pressure is 0 at such a
   wall; in fluid at rest it is rho0 g. Were an image at the depth y behind the wall to have 2 rho0 g y more,
   along the normal, this would add to the force on a particle at the distance d

     -m g lift(d),   lift(d) = V0 sum F x_n 2 y,   F = -W'(r) / r, x_n = d + y

   over the lattice behind the wall. Where its layers are even planes lift is t^5 (3 - 2 t), t = 1 - d / h, of
   the kernel (1 - r / h)^3 in three dimensions: that is taken, scaled to be right for the first layer of the
   lattice; for the others it is off by 0.02 of a weight at most. As a function of the distance alone it is
   the gradient of an energy, and heats nothing. Along the wall there is no such part: the images of what
   falls fall with it. */
#ifndef SLOSH_WALL_LIFT_H
#define SLOSH_WALL_LIFT_H

#include "sim/box/wall.h"
#include "sim/kernel/lattice.h"

typedef struct WallLift {
    float reach; /* h, m */
    float scale; /* lift at the wall itself */
} WallLift;

/* `lattice` has the pressure's kernel. */
WallLift wall_lift_of(const Lattice *lattice, double spacing, double support_radius);

/* The parts of a particle's weight that the walls of the box hold, along each axis; x in the box's frame, m.
 */
void walls_lift(const WallLift *lift, const Walls *walls, const float x[3], float out[3]);

/* That of one wall at the distance d, m, as the sum over the lattice. */
double wall_lift_brute(const Lattice *lattice, double spacing, double support_radius, double d);

#endif
