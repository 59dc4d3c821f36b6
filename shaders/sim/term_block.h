/* Data of optional terms: surface tension, no-slip walls; filled by sim/gpu/compute/terms.c. */
#ifndef SLOSH_TERM_BLOCK_H
#define SLOSH_TERM_BLOCK_H

#include "shaders/shared/block.h"
#include "shaders/sim/bindings.h"

BLOCK_STRUCT(FluidTerms)
{
    float tension; /* Constants.tension */
    float wet;     /* wetting_curvature of sim/def/fluids.h, 1/m */
}
BLOCK_END(FluidTerms);

UNIFORM_BLOCK(TermBlock, TERM_BLOCK)
{
    float colour_scale;    /* of the colour field */
    float drag_range;      /* m */
    float friction_scale;  /* R F over f(r / h) of sim/viscosity, 1/m4 */
    float curvature_least; /* curvature_weight of sim/def/fluids.h: limit without a surface; limit of a
                              full surface */
    float curvature_whole;
    float curvature_crowd_least; /* CROWD_LEAST of sim/def/fluids.h */
    float curvature_full;        /* from here to curvature_most: CurvatureScale */
    float curvature_few;
    float curvature_crowd;
    float curvature_offset;
    float curvature_most;
    FluidTerms fluid_terms[FLUIDS_MOST];
    ivec3 drag_nodes;  /* of the tables of friction of one, two, three faces */
    vec3 drag_steps;   /* their inverse steps, 1/m */
    ivec3 drag_offset; /* index of the first entry */
    vec3 lid_velocity; /* of the top wall, m/s */
}
BLOCK_END(TermBlock);

#endif
