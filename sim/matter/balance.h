/* A start in balance: the pressure under which fluid at rest would not be compressed by gravity in its first
   moment, and the places in which it has the densities that go with it.

   div(grad p / rho - g) = 0, p = 0 at free surfaces, and nothing through walls. Fluid that rests has
   hydrostatic pressure by it, in layers too; what falls freely has none; what stands before it falls over, as
   a dam, has what it falls over with. */
#ifndef SLOSH_BALANCE_H
#define SLOSH_BALANCE_H

#include "sim/matter/touch.h"

/* Particles; more start at rest. A million take some 15 s of processor time. */
enum { BALANCE_MOST = 2000000 };

typedef struct Balance {
    Touches touches;
    const uint8_t *fluid;
    double density[FLUIDS_MAX]; /* rho0 of each, kg/m3 */
    double spacing;             /* m */
    uint32_t *order;            /* particles, what hangs together side by side */
    uint32_t *part_begin;       /* where the parts begin in it, and where the last one ends */
    size_t parts;
    double *work;                 /* for the solution */
    double *open_weight, *weight; /* of the equations, for each particle and each touch */
    uint32_t *other;              /* whom each touch is with, side by side */
} Balance;

/* Arguments as those of touches_create. False when memory is short. */
bool balance_create(Balance *balance, const WorldDef *def, const Periodic *periodic, size_t count,
                    const float *position, const uint8_t *fluid, const bool take[FLUIDS_MAX]);
void balance_destroy(Balance *balance);

/* Pa, of each particle, under `gravity` (m/s2, the box's frame); a part with no free surface has 0 at its
   top. */
void balance_pressure(Balance *balance, const double gravity[3], const float *position, float *pressure);

/* Moves particles to where each has the compression that is given, rho / rho0 - 1. A part with no free
   surface sinks from its lid where gravity is along an axis and nothing stands in it; else it keeps its
   volume. */
void balance_move(Balance *balance, const double gravity[3], const double *compression, float *position);

/* Moves particles of a lattice, with a flow that compresses nothing, into the gaps that the lattice leaves
   next to solids: the free surface sinks by what is missing there. The balance is of no more use then. */
void balance_fit(Balance *balance, float *position);

/* Where fluid ends upwards. */
typedef struct BalanceSurface {
    /* Of that fluid at x and z, m; false: nowhere in particular. */
    bool (*height)(const void *context, int fluid, double x, double z, double *y);
    const void *context;
} BalanceSurface;

/* Moves particles of a lattice so that its steps at a surface follow the surface, by a flow that compresses
   nothing; the balance is of no more use then. What the surface is above the steps in the mean stays. False
   when memory is short. */
bool balance_raise(Balance *balance, const BalanceSurface *surface, float *position);

#endif
