/* Constants of a world, filled by sim/gpu/compute/blocks.c. Number densities, volumes, masses and forces are
   in the units of sim/step/constants.h, except volumes for views. The backend fragment writes the same
   names before its shaders: sim/gpu/fragment/fragment.c. */
#ifndef SLOSH_CONSTANT_BLOCK_H
#define SLOSH_CONSTANT_BLOCK_H

#include "shaders/shared/block.h"
#include "shaders/sim/bindings.h"

BLOCK_STRUCT(Fluid)
{
    float mass;      /* of a particle over U, kg/m3 */
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
    float kernel_scale;        /* scale of the sum of kernel shapes */
    float pressure_scale;      /* of the gradient */
    float viscosity_scale;     /* of the Laplacian */
    float stiffness_scale;     /* relative change of density over relative change of n / n0 */
    float inverse_unit;        /* 1 / u, 1/m */
    float unit_volume;         /* U, m3 */
    float inverse_unit_volume; /* 1 / U */
    ivec3 first_cell;          /* of the grid, in cells from the box's centre */
    int particle_total;
    ivec3 grid_size; /* cells along each axis */
    int cell_total;
    int first_row;        /* of the rows of neighbour cells */
    int last_row;         /* after the last row */
    int first_single_row; /* rows of single cells, for periodic sides */
    int last_single_row;
    vec3 half_size;  /* of the box, whose floor is at y = 0, m */
    float wall_lift; /* WallLift.scale */
    int dimensions;  /* 2, 3 */
    Fluid fluids[FLUIDS_MOST];
    vec3 cell_origin;  /* with periodic sides floor((x - cell_origin) * cell_inverse) is the cell */
    vec3 cell_inverse; /* 1/m */
    vec3 box_low;      /* low corner of a box with periodic sides, m */
    vec3 box_whole;    /* size of the box, m */
    ivec3 cell_fold;   /* y, z, mask: sim/step/backend.h */
}
BLOCK_END(ConstantBlock);

#endif
