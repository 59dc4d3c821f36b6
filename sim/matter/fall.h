/* How far fluid can fall, and so how deep it can be. */
#ifndef SLOSH_FALL_H
#define SLOSH_FALL_H

#include "sim/matter/world_def.h"

/* From where a def's fluids start or come in, against gravity down to the end of the box, m; 0 without fluid
   or gravity. */
double greatest_fall(const WorldDef *def);

#endif
