/* Sums of a group of gauge.comp over its particles; sim/gpu/compute/read.c adds the groups. */
#ifndef SLOSH_GAUGE_PART_H
#define SLOSH_GAUGE_PART_H

#include "shaders/shared/block.h"

BLOCK_STRUCT(GaugePart)
{
    float density_error;  /* relative, compression only */
    float kinetic_energy; /* J */
    float potential_energy;
    float compression_energy;
    float greatest_compression;
    float unused[3]; /* padding, present in C anyway */
}
BLOCK_END(GaugePart);

#endif
