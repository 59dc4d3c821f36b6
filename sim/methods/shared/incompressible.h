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

/* The pairs of sim/methods/shared/pair_incompressible.h with boundary particles, one at a time
 * (sim/cpu/forces.c). */

/* Pair of push_sums: k F x_ib. */
void incompressible_push(const SolidPair *pair, float k, float force[3]);

/* Pair of friction_sums, with velocity u (m/s) of b relative to i; 0 if forces have no friction. */
void incompressible_rub(const SolidPair *pair, const float u[3], float force[3]);

/* Constants of a Jacobi solver for the number density on the lattice at rest. */

/* With x = x_i - x_j and F = -W' / r, over the neighbours within h. */
typedef struct JacobiLattice {
    double greatest; /* greatest eigenvalue of D^-1 A: over all waves k |sum F x sin(k x)|^2 / sum F^2 r^2 */
    double squares;  /* sum F^2 r^2, 1/m8, of the unscaled kernel */
} JacobiLattice;

#endif
