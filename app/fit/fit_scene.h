/* Writes the scene found by `slosh fit`. */
#ifndef SLOSH_FIT_SCENE_H
#define SLOSH_FIT_SCENE_H

#include "app/fit/fit_plan.h"

/* Returns true if the file may be written: no such file exists, or an older fit wrote the file. Returns
   false with the reason. */
bool fit_scene_check(const char *path, Error *error);

/* Writes the scene with the chosen settings. Comments give the reason for the choice and the scene's old
   values. Leaves out keys made useless by the settings. The file is complete or not written at all. */
bool fit_scene_write(const FitPlan *plan, Error *error);

#endif
