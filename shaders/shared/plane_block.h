/* A plane's rectangle, and how far its particles reach; render/plane/plane_sum.c fills it. Doubles, since a
   particle may be smaller than a sample of a thousand, and is to be right to 1e-4 there. */
#ifndef SLOSH_PLANE_BLOCK_H
#define SLOSH_PLANE_BLOCK_H

#include "shaders/shared/bindings.h"
#include "shaders/shared/block.h"

UNIFORM_BLOCK(PlaneBlock, PLANE_BLOCK)
{
    dvec3 plane_corner; /* m, box's frame */
    dvec3 plane_along;  /* samples a m */
    dvec3 plane_up;
    dvec3 plane_normal;  /* support radii a m */
    vec2 plane_side;     /* of a sample, m */
    vec2 plane_samples;  /* of the rectangle */
    float plane_support; /* radius, m */
    float plane_peak;    /* of the kernel: W = peak * shape(r / h), 1/m3 */
}
BLOCK_END(PlaneBlock);

#endif
