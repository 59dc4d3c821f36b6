/* Looks at a world for its outcome. */
#ifndef SLOSH_OUTCOME_WATCH_H
#define SLOSH_OUTCOME_WATCH_H

#include "app/outcome/outcome.h"
#include "sim/world/world.h"

/* Adds a look at the present state, which is to be sound; of a history that is full in place of the last one.
   `def` as the world was made of; `moved`: something beside the scene moves the box. Reads the particles:
   some ten steps' time. False when memory is short. */
bool outcome_look(OutcomeHistory *history, const WorldDef *def, bool moved, World *world);

/* A look at the places alone, for whoever looks often: of all particles, but whether they lie on others of
   some two thousand; and, where nothing `moved` the box, at its energy. Some third of a step's time. False
   when memory is short. */
bool outcome_glance(OutcomeLook *look, const WorldDef *def, bool moved, World *world);

/* What is known without looking at particles: their number and their speeds. */
OutcomeLook outcome_of_info(const WorldDef *def, const WorldInfo *info);

/* Takes what ended the run, if something did. */
void outcome_end(OutcomeHistory *history, const World *world);

#endif
