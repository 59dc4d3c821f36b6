/* What is constant while a world lives; sim/gl/compute/blocks.c fills it. Number densities, volumes, masses
   and forces are in the units of sim/world/constants.h, but for the volumes that views see. The backend
   fragment writes the same names before its shaders: sim/gl/fragment/constants.c. */
#ifndef SLOSH_CONSTANT_BLOCK_H
#define SLOSH_CONSTANT_BLOCK_H

#include "shaders/shared/block.h"
#include "shaders/sim/bindings.h"

BLOCK_STRUCT(Fluid)
{
    float mass;      /* of a particle, kg/m3 */
    float density;   /* at rest, kg/m3 */
    float stiffness; /* Pa */
    float viscosity; /* Pa s */
}
BLOCK_END(Fluid);

UNIFORM_BLOCK(ConstantBlock, CONSTANT_BLOCK)
{
    float support;             /* h, m */
    float inverse_support;     /* 1/m */
    float rest_number_density; /* n0 */
    float spacing;             /* m */
    float kernel_scale;        /* of the sum of the kernel's shape */
    float pressure_scale;      /* of its gradient's */
    float viscosity_scale;     /* of its Laplacian's */
    float stiffness_scale;     /* relative change of density over that of n / n0 */
    float inverse_unit;        /* 1 / u, 1/m */
    float unit_volume;         /* U, m3 */
    float inverse_unit_volume; /* 1 / U */
    ivec3 first_cell;          /* of the grid, in cells from the box's centre */
    int particle_total;
    ivec3 grid_size; /* cells along each axis */
    int cell_total;
    int first_row;        /* of the rows of cells next to a cell */
    int last_row;         /* behind them */
    int first_single_row; /* the same of single cells, where sides are periodic */
    int last_single_row;
    vec3 half_size;  /* of the box, whose floor is at y = 0, m */
    float wall_lift; /* WallLift.scale */
    int dimensions;  /* 2, 3 */
    Fluid fluids[FLUIDS_MOST];
    vec3 cell_origin;  /* with periodic sides floor((x - cell_origin) * cell_inverse) is the cell */
    vec3 cell_inverse; /* 1/m */
    vec3 box_low;      /* where a box with periodic sides begins, m */
    vec3 box_whole;    /* how large it is, m */
    ivec3 cell_fold;   /* y, z, mask: sim/world/cell_fold.h */
}
BLOCK_END(ConstantBlock);

#endif
