/* Worlds whose energy is not watched (sim/step/sentinel.h). */
#ifndef SIM_STEP_ENERGY_UNWATCHED_H
#define SIM_STEP_ENERGY_UNWATCHED_H

#include "slosh/def.h"

/* NULL if the watch works in such a world, but for fingers; otherwise the reason for users. */
const char *energy_unwatched(const WorldDef *def);

#endif
