/* Sums of a group of excess.comp over a column; decide.comp adds the groups. */
#ifndef SLOSH_EXCESS_PART_H
#define SLOSH_EXCESS_PART_H

#include "shaders/shared/block.h"

/* Part numbers for the scale of the residual and for the way since the lists were made; part 0 is for the
   residual. */
#define EXCESS_OF_SCALE 1
#define EXCESS_OF_WAY   2

/* Place of a missing column. */
#define EXCESS_NO_COLUMN 0xffffffffu

BLOCK_STRUCT(ExcessPart)
{
    float above; /* sum of positive values */
    float greatest;
    float power; /* conjugate gradients: plain sums of two further columns */
    float curvature;
}
BLOCK_END(ExcessPart);

#endif
