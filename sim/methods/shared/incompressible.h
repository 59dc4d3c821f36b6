/* Constants shared by methods with a fixed number density (Method.incompressible). */
#ifndef SIM_METHODS_SHARED_INCOMPRESSIBLE_H
#define SIM_METHODS_SHARED_INCOMPRESSIBLE_H

#include "sim/cpu/cpu.h"
#include "sim/kernel/kernel.h"
#include "sim/step/constants.h"
#include "sim/step/method.h"
#include "sim/step/substep.h"

#define INCOMPRESSIBLE_KERNEL KERNEL_WENDLAND_C2

/* The kernels of a method: Wendland C2 for density and for slopes. */
MethodKernels incompressible_kernels(const WorldDef *def);
/* Greatest rate of Morris's friction on the lattice, and the weights of wall friction. */
StepFriction incompressible_friction(const WorldDef *def, const Lattice *lattice);

/* Factors of the sums (sim/methods/shared/pair_incompressible.h) and of Jacobi's step; U is
 * Constants.unit_volume. */
typedef struct IncompressibleFactors {
    float gradient;          /* F = -W'(r) / r over f(r / h), of the density kernel, times U, 1/m2 */
    float friction_gradient; /* the same calibrated for gradients (sim/kernel/kernel.h) */
    float relaxation;        /* of Jacobi */
    float pressure_of_term;  /* p over k */
    float least_squares;     /* a part of sum F^2 r^2 on the lattice, times U^2, 1/m2 */
    float surface_lack;      /* the outermost row of a half-filled lattice: 1 - n / n0, */
    float surface_slope;     /* and |sum F x_ij|, times U, 1/m */
} IncompressibleFactors;

/* Needs the lattice and the unit volume of `constants`. `kept`: the factors of these constants, or zeros;
   then they are summed over lattices, once in the life of a world: no live key changes them. */
IncompressibleFactors incompressible_factors(const WorldDef *def, const Constants *constants,
                                             const IncompressibleFactors *kept);

/* Tolerance of a step of an incompressible method in calm fluid. */

/* A solver's residual e causes noise of pressure, rho (h / dt)^2 e. Pressure itself changes from particle to
   particle by rho h times the acceleration of fluid, g or v^2 / h. So steps of calm fluid leave less than
   `allowed`: the residual with noise equal to `part` of that change, but at least 1e-6, for single precision.
   A smaller residual means less boiling. `still`: the most that fluid at rest leaves. `dt`: the step, s.
   Without gravity the result is `allowed`. */
double incompressible_rest_residual(const Substep *step, double dt, double part, double still,
                                    double allowed);

/* Solids. For particle i a boundary particle is an image of i, as the walls of the box have images: with k_i,
   and twice in pushes. So no boundary particle pushes i along the solid, and pressure has no slope across the
   solid. Both are added:
   - along the solid, i gets only the fluid's part of the gradient of pressure. That part of the acceleration
     is multiplied by 1 / (1 - s), s = SOLID_SHARE.
   - across the solid, pressure at rest rises by rho g towards a boundary particle. So the solid bears
     SOLID_LIFT of the weight of i, as walls_lift says for walls (sim/box/box.h). Else pressures of rows next
     to a solid alternate. */

/* Columns of a method, from a first on, of particles next to solids; F as in pair_incompressible.h. */
enum {
    SOLID_SLOPE,                   /* sum F x_ib over boundary particles b, 1/m: 3 */
    SOLID_SHARE = SOLID_SLOPE + 3, /* boundary particles' part of sum F y^2 along the solid, over a whole
                                      lattice's */
    SOLID_LIFT,                    /* the same across the solid */
    SOLID_BY,                      /* acceleration by the solid, m/s2, or the way over dt, m: 3 */
    SOLID_COLUMNS = SOLID_BY + 3,
};

/* sqrt(g h), m/s. */
double incompressible_fall(const WorldDef *def);

/* n counts a boundary particle once, its rate by velocities twice: mirrored. Velocities or ways that keep the
   rate at 0 change n, and moves back to n0 after each step would put work into fluid at rest beside solids.
   So solvers hold n / n0 plus a boundary part: the second part of that rate over the steps before, at most
   BOUNDARY_MOST, fading at this rate, 1/s: within four times sqrt(h / g). */
double incompressible_boundary_fades(const WorldDef *def);

bool incompressible_has_solids(const Constants *constants);

/* Their rows, from the method's own column `first` on; `by_flags`: of SOLID_BY. */
#define SOLID_COLUMN_ROW(first, column, name, unit, components, is)                                          \
    {                                                                                                        \
        name, unit, .at = COLUMN_OWN((first) + (column)), components, COLUMN_FLOAT, .flags = (is),           \
                    .needed = incompressible_has_solids                                                      \
    }
#define SOLID_COLUMN_ROWS(first, by_flags)                                                                   \
    SOLID_COLUMN_ROW(first, SOLID_SLOPE, "solid_slope", "1/m", 3, COLUMN_SHADERS),                           \
        SOLID_COLUMN_ROW(first, SOLID_SHARE, "solid_share", "", 1, COLUMN_SHADERS),                          \
        SOLID_COLUMN_ROW(first, SOLID_LIFT, "solid_lift", "", 1, COLUMN_SHADERS),                            \
        SOLID_COLUMN_ROW(first, SOLID_BY, "solid_by", "", 3, by_flags)

/* Adds to acceleration or way a of particle i the pushes by the k of boundary particles, `push` SOLID_SLOPE,
   and the part along the solid; a has the pushes by the k of i. by: all of the solid's pushes. */
void solid_push(float *const *solid, size_t i, float push, float a[3], float by[3]);

/* The acceleration by which the solid bears gravity g, m/s2; `part`: 0 to 1. */
void solid_hold(float *const *solid, size_t i, const float g[3], float part, float a[3]);

/* The pairs of sim/methods/shared/pair_incompressible.h with boundary particles, one at a time
 * (sim/cpu/forces.c). */

/* The pair's part of `scale` SOLID_BY: by F across the solid, over SOLID_SLOPE. */
void incompressible_by_solid(const SolidPair *pair, float *const *solid, float scale, float force[3]);

/* Pair of friction_sums, with velocity u (m/s) of b relative to i; 0 if forces have no friction. */
void incompressible_rub(const SolidPair *pair, const float u[3], float force[3]);

/* Constants of a Jacobi solver for the number density on the lattice at rest. */

/* With x = x_i - x_j and F = -W' / r, over the neighbours within h. */
typedef struct JacobiLattice {
    double greatest; /* greatest eigenvalue of D^-1 A: over all waves k |sum F x sin(k x)|^2 / sum F^2 r^2 */
    double squares;  /* sum F^2 r^2, 1/m8, of the unscaled kernel */
} JacobiLattice;

#endif
