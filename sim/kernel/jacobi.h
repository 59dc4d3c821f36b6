/* What a solver that holds the number density finds on the lattice at rest. */
#ifndef SLOSH_JACOBI_H
#define SLOSH_JACOBI_H

#include "sim/kernel/kernel.h"

/* Of x = x_i - x_j and F = -W' / r, over the others within h. */
typedef struct JacobiLattice {
    double greatest; /* eigenvalue of D^-1 A: over all waves k |sum F x sin(k x)|^2 / sum F^2 r^2 */
    double squares;  /* sum F^2 r^2, 1/m8, of the kernel without a scale */
} JacobiLattice;

/* Of a lattice with that spacing and support radius h, m. */
JacobiLattice jacobi_lattice(const Kernel *kernel, int dimensions, double spacing, double h);

#endif
