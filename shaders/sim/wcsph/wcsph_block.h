/* Constants of wcsph, shared by C and shaders; filled by wcsph_set of sim/methods/wcsph/wcsph.c. */
#ifndef SLOSH_WCSPH_BLOCK_H
#define SLOSH_WCSPH_BLOCK_H

#include "shaders/shared/block.h"
#include "shaders/sim/bindings.h"

/* Storage buffers besides those of shaders/sim/bindings.h */
#define SLOPES_BUFFER      5
#define UNEVENS_BUFFER     7
#define CORRECTIONS_BUFFER 9
#define OUTWARDS_BUFFER    10

/* Least density for friction, over rho0: a particle that carries less has a wrong density after a splash,
   and would not be stable at the usual step: docs/labbook/failures.md. */
#define THINNEST 0.9f

/* Fluids with a greater density contrast share pressure by density: sim/methods/wcsph/pairs_surface.c. */
#define CONTRAST_LEAST 4.0f

/* Distance to solids, over h, below which diffusion uses differences alone. */
#define NEXT_TO_SOLID 0.95f

BLOCK_STRUCT(WcsphFluid)
{
    float tait;                 /* B = rho0 c^2 / 7, Pa: p = B ((rho / rho0)^7 - 1) */
    float artificial_viscosity; /* alpha c (h / 2) rho0 / 2, Pa s; 0 for a fluid with at least that
                                   viscosity */
}
BLOCK_END(WcsphFluid);

UNIFORM_BLOCK(WcsphBlock, METHOD_BLOCK)
{
    float gradient_scale;   /* -W'(r) / r over f(r / h), calibrated, 1/m2; f by kernel */
    float diffusion;        /* 2 delta c (h / 2), m2/s; 0: none */
    float radial_friction;  /* R of sim/def/fluids.h, 1/m2; 0: friction in the form of Morris */
    float shift_speed;      /* chi c h / 2, m2/s; 0: none: Lind 2012 */
    float density_return;   /* of shifting and diffusion, 1/s */
    int kernel_shape;       /* a ShapeKernel of sim/kernel/kernel.h */
    int corrected_gradient; /* sim/methods/wcsph/wcsph_passes.c */
    int any_artificial;     /* some fluid has an artificial viscosity */
    float inverse_sound2;   /* 1 / c^2, s2/m2 */
    float boundary_fades;   /* of the boundary part of compression, 1/s */
    WcsphFluid wcsph_fluids[FLUIDS_MOST];
}
BLOCK_END(WcsphBlock);

#endif
