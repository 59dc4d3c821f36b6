/* Keys of a scene that may change while it is simulated and shown. */
#ifndef SLOSH_SCENE_LIVE_H
#define SLOSH_SCENE_LIVE_H

#include "app/scene.h"
#include "sim/error.h"

#include <stdbool.h>

/* Sets one key that the table of keys (app/scene_keys.h) calls live: "gravity=[0, -3, 0]", "view.range=auto",
   "fluids[1].viscosity=0.2", with the types, ranges and messages of `--set`. `concerns_world` (NULL allowed):
   whether a solver reads it. False with "SETTING: what is wrong; what would be right", and the scene is as it
   was. */
bool scene_set_live(Scene *scene, const char *setting, bool *concerns_world, Error *error);

#endif
