/* Constants shared by methods with a fixed number density (Method.incompressible). */
#ifndef SLOSH_INCOMPRESSIBLE_CONSTANTS_H
#define SLOSH_INCOMPRESSIBLE_CONSTANTS_H

#include "sim/kernel/kernel.h"
#include "sim/world/constants.h"
#include "sim/world/method.h"

#define INCOMPRESSIBLE_KERNEL KERNEL_WENDLAND_C2

/* The kernels of a method: Wendland C2 for density and for slopes. */
MethodKernels incompressible_kernels(const WorldDef *def);
/* Greatest rate of Morris's friction on the lattice, and the weights of wall friction. */
StepFriction incompressible_friction(const WorldDef *def, const Lattice *lattice);

/* Factors of the sums (sim/incompressible/pairs.h) and of Jacobi's step; U is Constants.unit_volume. */
typedef struct IncompressibleFactors {
    float gradient;          /* F = -W'(r) / r over f(r / h), of the density kernel, times U, 1/m2 */
    float friction_gradient; /* the same calibrated for gradients (sim/kernel/lattice.h) */
    float relaxation;        /* of Jacobi */
    float pressure_of_term;  /* p over k */
    float least_squares;     /* a part of sum F^2 r^2 on the lattice, times U^2, 1/m2 */
} IncompressibleFactors;

/* Needs the lattice and the unit volume of `constants`. */
IncompressibleFactors incompressible_factors(const WorldDef *def, const Constants *constants);

#endif
