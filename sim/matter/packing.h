/* An order of particles at the start around solids, stable under an even pressure.

   after: A. Colagrossi, B. Bouscasse, M. Antuono, S. Marrone, "Particle packing algorithm for SPH schemes",
   2012

   Next to a round solid the lattice is cut, and the fluid finds an order there in the first moments. A method
   with carried density takes the motion for compression, and without diffusion keeps the error: pressure next
   to a disc stays 7 % of rho0 g H too high. */
#ifndef SLOSH_PACKING_H
#define SLOSH_PACKING_H

#include "sim/kernel/lattice.h"
#include "sim/matter/boundary.h"

typedef struct Packing {
    const WorldDef *def;
    const Lattice *lattice;
    const Boundary *boundary;
    const bool *take; /* FLUIDS_MAX: fluids with particles to move */
} Packing;

/* Moves particles of the fluids in `take`, at `position` (3 each, m), within a support radius of a solid.
   They move down the gradient of the number density of all particles, and into no solid. Particles near a
   surface, a wall or a periodic side stay, like all without neighbours all around. Returns false if memory is
   short. */
bool packing_settle(const Packing *packing, size_t count, const uint8_t *fluid, float *position);

#endif
