/* What the kernels give on an infinite cubic lattice at rest, and the factors that make them right there.

   A kernel that integrates to 1 does not sum to 1 over particles. The density kernel is scaled so that the
   lattice has exactly one particle a volume spacing^3, and with the mass rho0 spacing^3 exactly the rest
   density; pressure gradient, viscous Laplacian and stiffness are scaled so that they are exact for linear
   pressure, quadratic velocity and uniform compression on it. Without that a column at support 2.1 would
   stand 4 % too high in pressure and sound would travel 10 % too slowly. */
#ifndef SLOSH_LATTICE_H
#define SLOSH_LATTICE_H

#include "sim/kernel/kernel.h"

typedef struct Lattice {
    int dimensions;        /* 3, or 2: a square lattice; then all 1/m3 are 1/m2 */
    double number_density; /* n0 = 1 / spacing^dimensions; mass = rho0 / n0, in 2D of a metre's depth */
    double density_scale;  /* factor on the density kernel: n0 over its sum, self included */
    double gradient_scale; /* factor on the derivative of the pressure kernel */
    const Kernel *pressure_kernel;
    double laplacian_scale; /* factor on the Laplacian of the viscosity kernel */
    /* R, 1/m2, in the radial form of friction (sim/matter/viscosity.h): with sum V F x^2 = 1 the force is
       mu (laplacian v + 2 grad div v) where R sum V F x^2 y^2 = 1, of all directions together
       R = d (d + 2) / sum V F r^4, F = -W' / r */
    double radial_scale;
    double stiffness_scale; /* relative change of volume over that of n / n0 */
    int neighbours;         /* others with r < h */
} Lattice;

/* Of the lattice with that spacing and support radius, m. */
void lattice_calibrate(int dimensions, double spacing, double support_radius, const Kernel *density_kernel,
                       const Kernel *pressure_kernel, Lattice *lattice);

#endif
