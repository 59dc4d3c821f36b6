/* Constants of a Jacobi solver for the number density on the lattice at rest. */
#ifndef SLOSH_JACOBI_H
#define SLOSH_JACOBI_H

#include "sim/kernel/kernel.h"

/* With x = x_i - x_j and F = -W' / r, over the neighbours within h. */
typedef struct JacobiLattice {
    double greatest; /* greatest eigenvalue of D^-1 A: over all waves k |sum F x sin(k x)|^2 / sum F^2 r^2 */
    double squares;  /* sum F^2 r^2, 1/m8, of the unscaled kernel */
} JacobiLattice;

/* For a lattice with the given spacing and support radius h, m. */
JacobiLattice jacobi_lattice(const Kernel *kernel, int dimensions, double spacing, double h);

#endif
