/* Takes looks at a world, to judge its outcome. */
#ifndef SLOSH_OUTCOME_WATCH_H
#define SLOSH_OUTCOME_WATCH_H

#include "app/outcome/outcome.h"
#include "sim/world/world.h"

/* Adds a look at the present state, which must be sound; a full history's last look is replaced. `def`:
   definition of the world; `moved`: the box is moved by other means than the scene. Reads the particles:
   takes about ten steps' time. Returns false if memory is short. */
bool outcome_look(OutcomeHistory *history, const WorldDef *def, bool moved, World *world);

/* A cheaper look at positions alone, for frequent use: all particles for leaks, but about two thousand for
   clumps; and the energy unless the box is `moved`. Takes about a third of a step's time. Returns false if
   memory is short. */
bool outcome_glance(OutcomeLook *look, const WorldDef *def, bool moved, World *world);

/* Returns the facts known without reading particles: their number and speeds. */
OutcomeLook outcome_of_info(const WorldDef *def, const WorldInfo *info);

/* Records the trouble that ended the run, if any. */
void outcome_end(OutcomeHistory *history, const World *world);

#endif
