/* Greatest fall of fluid, which bounds its depth. */
#ifndef SLOSH_FALL_H
#define SLOSH_FALL_H

#include "sim/matter/world_def.h"

/* Distance from the highest start or emitter of the def's fluids, against gravity, down to the end of the
   box, m; 0 without fluid or gravity. */
double greatest_fall(const WorldDef *def);

#endif
