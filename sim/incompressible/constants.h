/* What methods that hold the number density (Method.incompressible) make of a def alike. */
#ifndef SLOSH_INCOMPRESSIBLE_CONSTANTS_H
#define SLOSH_INCOMPRESSIBLE_CONSTANTS_H

#include "sim/kernel/kernel.h"
#include "sim/world/method.h"

#define INCOMPRESSIBLE_KERNEL KERNEL_WENDLAND_C2

MethodKernels incompressible_kernels(const WorldDef *def);
StepFriction incompressible_friction(const WorldDef *def, const Lattice *lattice);

/* The factors of their sums (sim/incompressible/pairs.h) and of Jacobi's step. */
typedef struct IncompressibleFactors {
    float gradient;          /* F = -W'(r) / r over f(r / h), of the kernel that sums density, 1/m5 */
    float friction_gradient; /* the same calibrated for gradients (sim/kernel/lattice.h) */
    float relaxation;        /* of Jacobi */
    float pressure_of_term;  /* p over k, 1/m6 */
    float least_squares;     /* a part of sum F^2 r^2 on the lattice, 1/m8 */
} IncompressibleFactors;

IncompressibleFactors incompressible_factors(const WorldDef *def, const Lattice *lattice);

#endif
