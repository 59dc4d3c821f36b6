/* An order of the start around solids that an even pressure leaves as it is.

   after: A. Colagrossi, B. Bouscasse, M. Antuono, S. Marrone, "Particle packing algorithm for SPH schemes",
   2012

   Next to a round solid the lattice is cut, and the fluid finds its order there in the first moments. A
   method whose particles carry their density takes that for compression, and without diffusion keeps it:
   pressure next to a disc stays 7 % of rho0 g H too high. */
#ifndef SLOSH_PACKING_H
#define SLOSH_PACKING_H

#include "sim/kernel/lattice.h"
#include "sim/matter/boundary.h"

typedef struct Packing {
    const WorldDef *def;
    const Lattice *lattice;
    const Boundary *boundary;
    const bool *take; /* FLUIDS_MAX: whose particles move */
} Packing;

/* Moves the particles of those fluids at `position` (3 each, m) that are within a support radius of a solid
   down the gradient of the number density of all, and into no solid. Those near a surface, a wall or a
   periodic side stay, as all that have not their neighbours all around. False when memory is short. */
bool packing_settle(const Packing *packing, size_t count, const uint8_t *fluid, float *position);

#endif
