/* No-slip walls of the box: the friction of the lattice behind them.

   after: J. P. Morris, P. J. Fox, Y. Zhu, "Modeling low Reynolds number incompressible flows using SPH",
   1997, sec. 3.7: to fluid at the distance d in front of a wall, a wall particle at the depth u behind it has
   the mirrored velocity -v u / max(d, spacing / 2), so that velocities go on linearly through zero at the
   wall. All of a wall's viscous pair terms are then proportional to the particle's own velocity:

     force_i = -mu_i V_i V0 D v_i,   D = sum w(r) (1 + u / max(d, spacing / 2)),   V0 = 1 / n0

   over the wall particles, where w is what the method's viscosity weighs pairs with. D times a volume, of the
   caller's choice, so that it fits in a float whatever the spacing, is tabulated over the
   distances, as the density is in sim/box/wall.h: faces - edges + corners. A wall particle behind several
   faces has the greatest of their factors; so edges and corners are tabulated with the least.

   The wall's lattice continues that of the particle itself: a shear that is linear is free of force on the
   lattice at rest, to rounding, in every layer. Over the lattice's other positions along the wall D varies by
   3 %. */
#ifndef SLOSH_WALL_DRAG_H
#define SLOSH_WALL_DRAG_H

#include "sim/kernel/lattice.h"

#include <stdbool.h>

typedef struct WallDrag {
    int dimensions;        /* 2: no wall in z */
    bool open[3];          /* periodic: no wall across this axis */
    float half_size[3];    /* of the box, m; the box's frame has its floor at y = 0 */
    float range;           /* beyond this distance a wall adds nothing, m */
    int nodes[3];          /* along a side of the tables of faces, edges, corners: at d = k / inverse_step */
    float inverse_step[3]; /* 1/m */
    float *table[3];       /* owned; the last index runs fastest; NULL: not made, or no corners in 2D */
} WallDrag;

typedef enum DragWeight { DRAG_LAPLACIAN, DRAG_MORRIS, DRAG_RADIAL } DragWeight;

/* w(r), 1/m5, of a wall particle at the distance `normal` from the fluid's along the wall's normal: Müller's
   Laplacian; 2 F = -2 W'(r) / r with the pressure kernel; or what the radial form of sim/matter/viscosity.h
   has of it for velocities along the wall, 2 R F (r^2 - normal^2) / (dimensions - 1), taken for all
   velocities: across the wall there are none. */
double wall_drag_weight(const Lattice *lattice, DragWeight weight, double r, double normal,
                        double support_radius);

/* False when memory is short. */
bool wall_drag_create(WallDrag *drag, const double box_size[3], const bool open[3], double spacing,
                      double support_radius, const Lattice *lattice, double unit_volume, DragWeight weight);
void wall_drag_destroy(WallDrag *drag);

/* D unit_volume at x (box's frame, m, inside the box), 1/m2. */
float wall_drag_at(const WallDrag *drag, const float x[3]);

/* The part of D that the wall at the top has of it: where it moves with the velocity V, and the mirrored
   velocities about V, the friction is -mu_i V_i V0 (D v_i - D_top V). What stands behind it and a wall at
   rest counts for the nearer one. */
float wall_drag_lid(const WallDrag *drag, const float x[3]);

#endif
