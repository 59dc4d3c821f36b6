/* What hands have done to a scene that runs, as that scene's own. */
#ifndef SLOSH_SETTLE_H
#define SLOSH_SETTLE_H

#include "sim/matter/world_def.h"

#include <stdint.h>

/* Solids stand where a hand has sent them, and move from there as they did; emitters and drains are shut at
   the start where they are in `shut` (gates of sim/matter/flow.h). Afterwards no hand has moved a solid. */
void settle_world(WorldDef *def, uint64_t shut);

#endif
