/* The scene that `slosh fit` writes. */
#ifndef SLOSH_FIT_SCENE_H
#define SLOSH_FIT_SCENE_H

#include "app/fit/fit_plan.h"

/* Whether it may be written: nothing has that name, or an older fit wrote it. False with the reason. */
bool fit_scene_check(const char *path, Error *error);

/* The scene with the settings that were chosen, why they were, and what the scene had, as comments: whole or
   not at all. Keys that the settings made useless are left out. */
bool fit_scene_write(const FitPlan *plan, Error *error);

#endif
