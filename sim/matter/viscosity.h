/* The forms of laminar viscosity (solver.viscosity_form): what a pair's friction acts along.

   morris: V_i V_j (mu_i + mu_j) F v_ji, after Morris 1997: mu times the Laplacian of the velocity. Exact for
   shears, but it dissipates mu |grad v|^2: right inside a fluid without divergence, where that and 2 mu D : D
   (D = (grad v + grad v^T) / 2) differ by what integrates to nothing, and half of the fluid's at the free
   surface of a flow without rotation. It brakes a body that turns as a whole.

   radial: V_i V_j (mu_i + mu_j) R F (v_ji . x_ij) x_ij, along the line between the two: keeps angular
   momentum, and its work is 2 mu D : D whatever the surface; R is Lattice.radial_scale. After J. J. Monaghan,
   R. A. Gingold, "Shock simulation by the particle method SPH", 1983, and for the surface A. Colagrossi, M.
   Antuono, D. Le Touze, "Theoretical considerations on the free-surface role in the
   smoothed-particle-hydrodynamics model", Phys. Rev. E 79, 056701, 2009. There the weight is R F h^2 / r^2,
   with 2 (d + 2) for R h^2 and both viscosities: then particles on a lattice feel a shear along it by 6 to 30
   % less and a stretch by as much more. Without the 1 / r^2, which leaves more of the weight to farther
   neighbours, both are right within 2.5 %. */
#ifndef SLOSH_VISCOSITY_H
#define SLOSH_VISCOSITY_H

#include "sim/kernel/lattice.h"

typedef enum ViscosityForm { VISCOSITY_MORRIS, VISCOSITY_RADIAL } ViscosityForm;

/* What stands for mu_i + mu_j in both: twice the harmonic mean, after P. W. Cleary, J. J. Monaghan,
   "Conduction modelling using smoothed particle hydrodynamics", 1999, eq. 26, so that two layers have one
   shear stress and the kink of their speeds lies between them. With the mean the thin one would be thick as
   far as the kernel reaches. Of equal ones their sum; 0 where one has none: along an inviscid fluid all
   slips. Pa s. */
double pair_viscosity(double a, double b);

/* How a step takes friction (solver.viscosity): by the velocities at its begin, or at its end. */
typedef enum ViscositySolver { VISCOSITY_EXPLICIT, VISCOSITY_IMPLICIT } ViscositySolver;

typedef struct ViscosityKind {
    const char *name, *help;
} ViscosityKind;

extern const ViscosityKind viscosity_kinds[];   /* in the order of ViscosityForm, ended by a NULL name */
extern const ViscosityKind viscosity_solvers[]; /* in the order of ViscositySolver, the same */

/* What levels differences of velocity: Müller's Laplacian, the two forms above, the artificial viscosity.
 */
typedef enum Friction { FRICTION_LAPLACIAN, FRICTION_MORRIS, FRICTION_RADIAL, FRICTION_ARTIFICIAL } Friction;

/* How fast at most it levels them on the lattice of that spacing (m) at rest, 1/s for a kinematic viscosity
   of 1 m2/s (of the artificial one for alpha c h / 4): the greatest eigenvalue of its pair terms. An explicit
   step stands less than twice the inverse. `summed` is the kernel that density is summed by: in films and
   threads, where it is low, friction is stronger, and the greatest of all three counts. NULL: particles carry
   their density. */
double friction_rate(const Lattice *lattice, double spacing, Friction friction, double support_radius,
                     const Kernel *summed);

#endif
