/* A slice's rectangle, and how far its particles reach; render/slice/slice_sum.c fills it. Doubles, since a
   particle may be smaller than a sample of a thousand, and is to be right to 1e-4 there. */
#ifndef SLOSH_SLICE_BLOCK_H
#define SLOSH_SLICE_BLOCK_H

#include "shaders/shared/block.h"
#include "shaders/slice/slice_bindings.h"

UNIFORM_BLOCK(SliceBlock, SLICE_BLOCK)
{
    dvec3 slice_corner; /* m, box's frame */
    dvec3 slice_along;  /* samples a m */
    dvec3 slice_up;
    dvec3 slice_normal;  /* support radii a m */
    vec2 slice_side;     /* of a sample, m */
    vec2 slice_samples;  /* of the rectangle */
    float slice_support; /* radius, m */
    float slice_peak;    /* of the kernel: W = peak * shape(r / h), 1/m3 */
}
BLOCK_END(SliceBlock);

#endif
