/* Surface tension, for scenes with a model: three models, each a separate sum over pairs. */
#ifndef SIM_DEF_FLUIDS_H
#define SIM_DEF_FLUIDS_H

#include "sim/box/box.h"
#include "sim/def.h"
#include "sim/kernel/kernel.h"

typedef enum TensionModel {
    TENSION_NONE,
    TENSION_COLOUR_FIELD,
    TENSION_COHESION,
    TENSION_CURVATURE
} TensionModel;

typedef struct TensionKind {
    const char *name, *help;
} TensionKind;

extern const TensionKind tension_kinds[]; /* in the order of TensionModel, ended by a NULL name */

/* Akinci, Akinci, Teschner 2013, eq. 2, without its factor 32 / (pi h^9): positive attracts; zero for
   r >= h. m6 for r and h in m. */
double cohesion_kernel(double r, double h);

/* Factor g in the force -g V_i V_j C(r) (x_ij / r) for a tension of 1 N/m at a flat surface. The tension is
   half the work per area to part the lattice at rest along a lattice plane. */
double cohesion_scale(int dimensions, double spacing, double h);

/* Pressure, Pa, by which cohesion presses a fluid of the def together: some 5 sigma / spacing, measured on
   drops of 552 particles at compressions of 0.4 to 6 %. */
double cohesion_pressure(const WorldDef *def, int fluid);

/* For the model `curvature`, with the normals N = sum (1 - r/h)^3 x_ij of a fluid. The part of a surface per
   particle follows from |N| over the |N| of the lattice's outermost layer. */
typedef struct CurvatureScale {
    float full;   /* 1 over |N| of the outermost layer, 1/m */
    float layers; /* sum of curvature_weight over the lattice's layers */
    float few;    /* least sum of (1 - r/h)^3 t^2, t along the surface, for a curvature, m2 */
    float crowd;  /* 1 over sum (1 - r/h)^3 t^2 at the surface of a fluid in motion, 1/m2 */
    float offset; /* apparent loss of a drop's radius, over (d - 1), m: see curvature_calibrate */
    float most;   /* greatest curvature, 1/m: of a drop of some spacings */
} CurvatureScale;

enum {
    CURVATURE_LEAST = 10,
    CURVATURE_WHOLE = 40
}; /* percent of |N|: below, no surface; above, a whole
      surface */

/* The force of a particle is divided by x^(3/8), x the crowd along the surface: sum (1 - r/h)^3 t^2 over the
   sum at the surface of a fluid in motion. New particles come up into a stretched surface only later. Without
   the division a stretched surface would pull less than a shrinking surface, and the flow would gain energy.
   Sparser surfaces count as having the least crowd. */
#define CROWD_LEAST 0.2F

/* Pressure ends where the force begins, and pairs across a surface are missing. So SPH feels pressure as if a
   drop were smaller by (d - 1) times the offset: by (centroid of the weights) + (d - 1) (half the kernel's
   mean |z|). With the offset a drop at rest has the right pressure; an oscillation wants half of the
   offset. */
CurvatureScale curvature_calibrate(int dimensions, double spacing, double h);

/* Factor f, 1/m, of a wall with contact angle `angle`, degrees: a surface at distance d from the wall loses
   the curvature f (1 - d/h)^2. Over the lattice's layers the wall pulls with sigma cos(angle) in all, after
   Young. */
double wetting_curvature(double angle, double spacing, double h);

/* poly6's factor in the colour field's gradient and Laplacian (Müller 2003, eq. 15 to 19): 945 / (32 pi h^9),
   in two dimensions 24 / (pi h^8). */
double colour_scale(int dimensions, double h);

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

/* Rate of friction for a def's method, kernel, support and dimensions, 1/m2. */
typedef struct StepFriction {
    double laminar, artificial; /* artificial: 0 if not in the def */
    double alpha;               /* of the artificial viscosity */
    double numerical;           /* the least viscosity between pairs of fluid, m2/s */
    const char *numerical_key;  /* the key that gives it */
    DragWeight walls;           /* weights of the friction at no-slip walls */
} StepFriction;

#endif
