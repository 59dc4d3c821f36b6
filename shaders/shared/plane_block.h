/* A plane's rectangle and the particles' support; filled by render/particles/plane.c. Doubles, since a
   particle may be smaller than a sample of a thousand, with errors of 1e-4 at most. */
#ifndef SLOSH_PLANE_BLOCK_H
#define SLOSH_PLANE_BLOCK_H

#include "shaders/shared/bindings.h"
#include "shaders/shared/block.h"

UNIFORM_BLOCK(PlaneBlock, PLANE_BLOCK)
{
    dvec3 plane_corner; /* m, box's frame */
    dvec3 plane_along;  /* samples per m */
    dvec3 plane_up;
    dvec3 plane_normal;  /* support radii per m */
    vec2 plane_side;     /* size of a sample, m */
    vec2 plane_samples;  /* samples of the rectangle */
    float plane_support; /* radius, m */
    float plane_peak;    /* peak of the kernel: W = peak * shape(r / h), 1/m3 */
}
BLOCK_END(PlaneBlock);

#endif
