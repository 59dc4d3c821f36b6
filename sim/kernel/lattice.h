/* Kernel sums on an infinite cubic lattice at rest, and factors to correct these sums.

   A kernel that integrates to 1 does not sum to 1 over particles. The density kernel is scaled so that the
   lattice has exactly one particle per volume spacing^3, and with the mass rho0 spacing^3 exactly the rest
   density. Pressure gradient, viscous Laplacian and stiffness are scaled to be exact on the lattice for
   linear pressure, quadratic velocity and uniform compression. Without scaling, pressure in a column at
   support 2.1 would be 4 % too high and sound 10 % too slow. */
#ifndef SLOSH_LATTICE_H
#define SLOSH_LATTICE_H

#include "sim/kernel/kernel.h"

typedef struct Lattice {
    int dimensions;        /* 3, or 2: a square lattice; then all 1/m3 are 1/m2 */
    double number_density; /* n0 = 1 / spacing^dimensions; mass = rho0 / n0, in 2D for a depth of a metre */
    double density_scale;  /* factor on the density kernel: n0 over its sum, with the particle itself */
    double gradient_scale; /* factor on the derivative of the pressure kernel */
    const Kernel *pressure_kernel;
    double laplacian_scale; /* factor on the Laplacian of the viscosity kernel */
    /* R, 1/m2, in the radial form of friction (sim/matter/viscosity.h). With sum V F x^2 = 1 the force is
       mu (laplacian v + 2 grad div v) if R sum V F x^2 y^2 = 1; over all directions R = d (d + 2) / sum V F
       r^4, F = -W' / r */
    double radial_scale;
    double stiffness_scale; /* relative change of volume over relative change of n / n0 */
    int neighbours;         /* neighbours with r < h */
} Lattice;

/* Calibrates for a lattice with the given spacing and support radius, m. */
void lattice_calibrate(int dimensions, double spacing, double support_radius, const Kernel *density_kernel,
                       const Kernel *pressure_kernel, Lattice *lattice);

#endif
