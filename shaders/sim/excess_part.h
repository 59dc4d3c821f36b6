/* What a group of excess.comp sums up of a column; decide.comp adds the groups' up. */
#ifndef SLOSH_EXCESS_PART_H
#define SLOSH_EXCESS_PART_H

#include "shaders/shared/block.h"

BLOCK_STRUCT(ExcessPart)
{
    float above; /* the sum of what is above 0 */
    float greatest;
}
BLOCK_END(ExcessPart);

#endif
