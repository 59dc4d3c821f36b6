/* What the files of mueller share: its constants, columns and passes. */
#ifndef SIM_METHODS_MUELLER_MUELLER_PRIVATE_H
#define SIM_METHODS_MUELLER_MUELLER_PRIVATE_H

#include "sim/methods/mueller/mueller.h"

#include "shaders/sim/mueller/mueller_block.h"
#include "sim/box/box.h"
#include "sim/cpu/cpu.h"
#include "sim/step/method.h"

/* Passes and columns of mueller. */

/* The kernels of solver.density_kernel, in the order of density_kernels. */
typedef enum DensityKernel { DENSITY_SPIKY, DENSITY_POLY6, DENSITY_QUINTIC } DensityKernel;

/* Constants of mueller alone. */
typedef struct MuellerConstants {
    MuellerBlock sums;
    DensityKernel kernel;
} MuellerConstants;

/* The boundary part: n / n0 by boundary particles, less the mean of BOUNDARY_FADES times the crossing of a
   support radius by sound; at most BOUNDARY_MOST of the compression by a layer's weight. Pressure next to
   solids sees the boundary part: a boundary particle pushes with p_i + p_b, twice what its part of n stores.
   Without the boundary part fluid above a plate hums (0.026 sqrt(g H)); unbounded, round solids stir fluid at
   rest. */
#define BOUNDARY_FADES 10.0F
#define BOUNDARY_MOST  0.2F

/* Columns of mueller alone: indices in ParticleColumns.own. */
enum {
    BOUNDARY_MEAN, /* mean of n / n0 by boundary particles; 0: none in reach */
};

static inline const MuellerConstants *mueller_constants(const Constants *constants)
{
    return (const MuellerConstants *)(const void *)constants->of_method;
}

/* Equation of state, p = c^2 (rho - rho0), for `crowded` = n / n0 - 1: Müller 2003, eq. 12. */
static inline float mueller_state(const Constants *constants, int fluid, float crowded)
{
    return constants->stiffness[fluid] * crowded;
}

/* Number density, volume and pressure of every particle: Müller 2003, eq. 3 and 12. */
extern const Pass mueller_densities;

/* Accelerations by pressure, viscosity, walls and solids: eq. 10 and 14. */
extern const Pass mueller_forces;

extern const ColumnDef mueller_columns[];

#endif
