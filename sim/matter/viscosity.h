/* Forms of laminar viscosity (solver.viscosity_form): the direction of a pair's friction.

   morris: V_i V_j (mu_i + mu_j) F v_ji, after Morris 1997: mu times the Laplacian of the velocity. Exact for
   shears, but dissipates mu |grad v|^2 in place of 2 mu D : D, D = (grad v + grad v^T) / 2. Inside a fluid
   without divergence the difference integrates to 0. At the free surface of a flow without rotation the form
   has half of the fluid's dissipation. A body in rigid rotation is braked.

   radial: V_i V_j (mu_i + mu_j) R F (v_ji . x_ij) x_ij, along the line between the two particles. Keeps
   angular momentum, with the work 2 mu D : D at any surface; R is Lattice.radial_scale. After J. J. Monaghan,
   R. A. Gingold, "Shock simulation by the particle method SPH", 1983, and for the surface A. Colagrossi, M.
   Antuono, D. Le Touze, "Theoretical considerations on the free-surface role in the
   smoothed-particle-hydrodynamics model", Phys. Rev. E 79, 056701, 2009. There the weight is R F h^2 / r^2,
   with 2 (d + 2) for R h^2 and both viscosities. With 1 / r^2, particles on a lattice feel a shear along the
   lattice by 6 to 30 % less and a stretch by as much more. Without 1 / r^2 farther neighbours keep more of
   the weight, and both are right within 2.5 %. */
#ifndef SLOSH_VISCOSITY_H
#define SLOSH_VISCOSITY_H

#include "sim/box/wall_drag.h"
#include "sim/kernel/lattice.h"

typedef enum ViscosityForm { VISCOSITY_MORRIS, VISCOSITY_RADIAL } ViscosityForm;

/* Stands for mu_i + mu_j in both forms: twice the harmonic mean, after P. W. Cleary, J. J. Monaghan,
   "Conduction modelling using smoothed particle hydrodynamics", 1999, eq. 26. So two layers have one shear
   stress, and the kink of their speeds lies between them. With the arithmetic mean the thin fluid would be
   thick as far as the kernel reaches. For equal viscosities the sum; 0 if a viscosity is 0: along an inviscid
   fluid all slips. Pa s. */
double pair_viscosity(double a, double b);

/* Velocities used by a step's friction (solver.viscosity): of the step's begin, or of its end. */
typedef enum ViscositySolver { VISCOSITY_EXPLICIT, VISCOSITY_IMPLICIT } ViscositySolver;

typedef struct ViscosityKind {
    const char *name, *help;
} ViscosityKind;

extern const ViscosityKind viscosity_kinds[];   /* in the order of ViscosityForm, ended by a NULL name */
extern const ViscosityKind viscosity_solvers[]; /* in the order of ViscositySolver, the same */

/* Kinds of friction: Müller's Laplacian, the two forms above, the artificial viscosity. */
typedef enum Friction { FRICTION_LAPLACIAN, FRICTION_MORRIS, FRICTION_RADIAL, FRICTION_ARTIFICIAL } Friction;

/* Greatest rate at which friction levels differences of velocity on the lattice of that spacing (m) at rest:
   the greatest eigenvalue of the pair terms. In 1/s for a kinematic viscosity of 1 m2/s (artificial
   viscosity: for alpha c h / 4). An explicit step stands less than twice the inverse. `summed` is the kernel
   of summed density: in films and threads density is low and friction stronger, and the greatest of thread,
   film and lattice counts. NULL: particles carry density. */
double friction_rate(const Lattice *lattice, double spacing, Friction friction, double support_radius,
                     const Kernel *summed);

/* Rate of friction (sim/matter/viscosity.h) for a def's method, kernel, support and dimensions, 1/m2. */
typedef struct StepFriction {
    double laminar, artificial; /* artificial: 0 if not in the def */
    double alpha;               /* of the artificial viscosity */
    double numerical;           /* alpha of the least viscosity between pairs of fluid */
    DragWeight walls;           /* weights of the friction at no-slip walls */
} StepFriction;

#endif
