/* Images next to their particles. For the files that are compiled once for each instruction set. */
#ifndef SLOSH_DFSPH_IMAGE_H
#define SLOSH_DFSPH_IMAGE_H

#include "sim/cpu/pair_images.h"

/* Of an image next to its particle: not 0. */
SIMD_INLINE f8 image_q(const Constants *s, f8 r2)
{
    const float h = s->support_radius, least = 1e-6f * h;
    return f8_sqrt(greater(r2, f8_splat(least * least))) * f8_splat(1 / h);
}

#endif
