/* What a group of excess.comp sums up of a column; decide.comp adds the groups' up. */
#ifndef SLOSH_EXCESS_PART_H
#define SLOSH_EXCESS_PART_H

#include "shaders/shared/block.h"

/* Which groups' parts are the scale of the residual; the residual's are the first. */
#define EXCESS_OF_SCALE 1

/* Instead of the place of a column: there is none. */
#define EXCESS_NO_COLUMN 0xffffffffu

BLOCK_STRUCT(ExcessPart)
{
    float above; /* the sum of what is above 0 */
    float greatest;
    float power; /* of conjugate gradients: sums of two other columns, whatever their signs */
    float curvature;
}
BLOCK_END(ExcessPart);

#endif
