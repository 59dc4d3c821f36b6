/* What only some scenes name: wcsph, surface tension, no-slip walls; sim/gl/compute/terms.c fills it. */
#ifndef SLOSH_TERM_BLOCK_H
#define SLOSH_TERM_BLOCK_H

#include "shaders/shared/block.h"
#include "shaders/sim/bindings.h"

BLOCK_STRUCT(FluidTerms)
{
    float tait; /* B of Tait's equation, Pa */
    float artificial_viscosity;
    float tension; /* N/m */
}
BLOCK_END(FluidTerms);

UNIFORM_BLOCK(TermBlock, TERM_BLOCK)
{
    float gradient_scale;  /* -W'(r) / r over f(r / h) */
    float diffusion;       /* of density */
    float colour_scale;    /* of the colour field */
    float radial_friction; /* R of solver.viscosity_form: radial */
    FluidTerms fluid_terms[FLUIDS_MOST];
    ivec3 drag_nodes;     /* of the tables of friction of one, two, three faces */
    float drag_range;     /* m */
    vec3 drag_steps;      /* their inverse steps, 1/m */
    float shift_speed;    /* chi c h / 2 */
    ivec3 drag_offset;    /* where they begin */
    float density_return; /* of shifting, 1/s */
    vec3 lid_velocity;    /* of the wall at the top, m/s */
}
BLOCK_END(TermBlock);

#endif
