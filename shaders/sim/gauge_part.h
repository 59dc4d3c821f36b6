/* What a group of gauge.comp sums up of its particles; sim/gl/compute/gauge.c adds the groups' up. */
#ifndef SLOSH_GAUGE_PART_H
#define SLOSH_GAUGE_PART_H

#include "shaders/shared/block.h"

BLOCK_STRUCT(GaugePart)
{
    float density_error;  /* relative, of what is pressed */
    float kinetic_energy; /* J */
    float potential_energy;
    float compression_energy;
    float greatest_compression;
    float unused[3]; /* C counts them in any case */
}
BLOCK_END(GaugePart);

#endif
