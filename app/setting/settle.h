/* Writes changes made by hand to a running scene into the scene's own definition. */
#ifndef SLOSH_SETTLE_H
#define SLOSH_SETTLE_H

#include "sim/matter/world_def.h"

#include <stdint.h>

/* Puts solids where a hand has moved them, with their motions continuing from there. Emitters and drains
   in `shut` (gates of sim/matter/flow.h) are closed at the start. Afterwards no solid counts as moved by
   hand. */
void settle_world(WorldDef *def, uint64_t shut);

#endif
