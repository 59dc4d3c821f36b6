/* Projection of points into a picture, and colours of the layers; filled by render/views/pbsr/average.c. */
#ifndef SLOSH_PBSR_BLOCK_H
#define SLOSH_PBSR_BLOCK_H

#include "shaders/pbsr/pbsr_bindings.h"
#include "shaders/shared/block.h"

#define PBSR_NUMBERS_MAX 16

UNIFORM_BLOCK(PbsrBlock, PBSR_BLOCK)
{
    ivec4 sets_part;                       /* the band in the picture: left, below, width, height; pixels */
    vec4 layer_color[PBSR_NUMBERS_MAX];    /* linear; alpha 0: colour by value */
    vec4 layer_light[PBSR_NUMBERS_MAX];    /* red: 1 lit, 0 plain; green: 1: values go by the colormap */
    vec4 layer_turn[3 * PBSR_NUMBERS_MAX]; /* columns: a layer's normals to the eye's frame */
    float value_low;                       /* low end of the colours' range */
    float value_scale;                     /* 1 / width of the range */
    float sets_near;                       /* near plane, m */
    int sets_first;                        /* first row of the band, in rows of the sight */
}
BLOCK_END(PbsrBlock);

#endif
