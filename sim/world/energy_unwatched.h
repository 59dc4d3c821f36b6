/* Worlds whose energy is not watched (sim/world/energy_watch.h). */
#ifndef SLOSH_ENERGY_UNWATCHED_H
#define SLOSH_ENERGY_UNWATCHED_H

#include "sim/matter/world_def.h"

/* NULL if the watch works in such a world, but for fingers; otherwise the reason for users. */
const char *energy_unwatched(const WorldDef *def);

#endif
