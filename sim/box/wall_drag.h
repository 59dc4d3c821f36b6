/* No-slip walls of the box: friction with a lattice of wall particles behind the walls.

   After: J. P. Morris, P. J. Fox, Y. Zhu, "Modeling low Reynolds number incompressible flows using SPH",
   1997, sec. 3.7. For fluid at distance d from a wall, a wall particle at depth u has the mirrored velocity
   -v u / max(d, spacing / 2), so that velocities continue linearly through zero at the wall. Then all
   viscous pair terms of a wall are proportional to the fluid particle's velocity:

     force_i = -mu_i V_i V0 D v_i, D = sum w(r) (1 + u / max(d, spacing / 2)), V0 = 1 / n0

   over the wall particles, where w is the pair weight of the method's viscosity. D times a volume chosen by
   the caller, to fit in a float for any spacing, is tabulated over the distances: faces - edges + corners.
   A wall particle behind several faces has the greatest of their factors, so edges and corners are
   tabulated with the least.

   The wall's lattice continues the lattice of the particle: a linear shear is free of force on the lattice
   at rest, up to rounding, in every layer. Over positions of the lattice along the wall, D varies by 3 %. */
#ifndef SLOSH_WALL_DRAG_H
#define SLOSH_WALL_DRAG_H

#include "sim/kernel/lattice.h"

#include <stdbool.h>

typedef struct WallDrag {
    int dimensions;        /* 2: no wall in z */
    bool open[3];          /* periodic: no wall across this axis */
    float half_size[3];    /* of the box, m; the box's frame has its floor at y = 0 */
    float range;           /* beyond this distance a wall has no effect, m */
    int nodes[3];          /* nodes per side in the tables of faces, edges, corners: at d = k /
                              inverse_step */
    float inverse_step[3]; /* 1/m */
    float *table[3];       /* owned; the last index runs fastest; NULL: not created, or no corners in 2D */
} WallDrag;

typedef enum DragWeight { DRAG_LAPLACIAN, DRAG_MORRIS, DRAG_RADIAL } DragWeight;

/* w(r), 1/m5, of a wall particle at distance `normal` along the wall's normal: Müller's Laplacian; 2 F,
   which is -2 W'(r) / r with the pressure kernel; or the radial form of sim/matter/viscosity.h for
   velocities along the wall, 2 R F (r^2 - normal^2) / (dimensions - 1), used for all velocities: there is
   no velocity across the wall. */
double wall_drag_weight(const Lattice *lattice, DragWeight weight, double r, double normal,
                        double support_radius);

/* Returns false if memory is short. */
bool wall_drag_create(WallDrag *drag, const double box_size[3], const bool open[3], double spacing,
                      double support_radius, const Lattice *lattice, double unit_volume, DragWeight weight);
void wall_drag_destroy(WallDrag *drag);

/* D unit_volume at x (box's frame, m, inside the box), 1/m2. */
float wall_drag_at(const WallDrag *drag, const float x[3]);

/* The top wall's part of D. If the top wall moves with velocity V, velocities are mirrored about V and the
   friction is -mu_i V_i V0 (D v_i - D_top V). A wall particle behind both the top wall and a wall at rest
   counts for the nearer wall. */
float wall_drag_lid(const WallDrag *drag, const float x[3]);

#endif
