/* An order of particles at the start around solids, stable under an even pressure.

   after: A. Colagrossi, B. Bouscasse, M. Antuono, S. Marrone, "Particle packing algorithm for SPH schemes",
   2012

   Next to a round solid the lattice is cut, and the fluid finds an order there in the first moments. A method
   with carried density takes the motion for compression, and without diffusion keeps the error: pressure next
   to a disc stays 7 % of rho0 g H too high. */
#ifndef SIM_START_REST_H
#define SIM_START_REST_H

#include "sim/flow/finger.h"
#include "sim/kernel/kernel.h"
#include "sim/solids/solid.h"

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

/* A start in balance: the pressure with which gravity does not compress resting fluid in the first moment,
   and positions with the densities of that pressure.

   div(grad p / rho - g) = 0, p = 0 at free surfaces, no flow through walls. Resting fluid gets hydrostatic
   pressure, in layers too; freely falling fluid gets none; a dam gets the pressure with which the dam begins
   to collapse. */

/* Greatest number of particles for a balanced start: worlds with more start at rest density. A million take
   some 15 s of processor time. */
enum { BALANCE_MOST = 2000000 };

typedef struct Balance {
    Touches touches;
    const uint8_t *fluid;
    double density[FLUIDS_MAX]; /* rho0 per fluid, kg/m3 */
    double spacing;             /* m */
    uint32_t *order;            /* particles, sorted by connected parts */
    uint32_t *part_begin;       /* index in `order` where each part begins, and the end of the last */
    size_t parts;
    double *work;                 /* for the solver */
    double *open_weight, *weight; /* of the equations, per particle and per touch */
    uint32_t *other;              /* neighbour of each touch, in an array without gaps */
} Balance;

/* Arguments as for touches_create. Returns false if memory is short. */
bool balance_create(Balance *balance, const WorldDef *def, const Periodic *periodic, size_t count,
                    const float *position, const uint8_t *fluid, const bool take[FLUIDS_MAX]);
void balance_destroy(Balance *balance);

/* Writes each particle's pressure, Pa, under `gravity` (m/s2, the box's frame). In a part with no free
   surface, pressure is 0 at the top. */
void balance_pressure(Balance *balance, const double gravity[3], const float *position, float *pressure);

/* Moves particles to positions with the given compression, rho / rho0 - 1. A part with no free surface sinks
   from the lid if gravity is along an axis and the world has no solids; else the part keeps its volume. */
void balance_move(Balance *balance, const double gravity[3], const double *compression, float *position);

/* Moves lattice particles, by a flow without compression, into the gaps that the lattice leaves next to
   solids: the free surface sinks by the missing volume. The balance is invalid afterwards. */
void balance_fit(Balance *balance, float *position);

/* Heights at which fluids end. */
typedef struct BalanceSurface {
    /* Surface height of that fluid at x and z, m; false: no particular height. */
    bool (*height)(const void *context, int fluid, double x, double z, double *y);
    const void *context;
} BalanceSurface;

/* Moves lattice particles, by a flow without compression, so that the lattice's steps at a surface follow the
   surface. The mean height of the surface above the steps stays. The balance is invalid afterwards. Returns
   false if memory is short. */
bool balance_raise(Balance *balance, const BalanceSurface *surface, float *position);

#endif
