/* Changing a scene while its simulation runs: what the panel and recorded commands set. */
#ifndef SLOSH_SCENE_LIVE_H
#define SLOSH_SCENE_LIVE_H

#include "app/scene/scene.h"

/* Sets one key that may change while the simulation runs (KEY_LIVE in app/scene/keys.h), such as
   "gravity=[0, -3, 0]", "view.range=auto", "fluids[1].viscosity=0.2", in a scene that was read and checked.
   Types, ranges, cross checks and messages ("--set path=value: ...") are those of `--set`. The camera's keys
   need a scene whose camera is not automatic. `concerns_world` (may be NULL) tells whether a solver reads the
   key: then world_change has to follow. False with the reason: scene and *concerns_world are as they were. */
bool scene_set_live(Scene *scene, const char *setting, bool *concerns_world, Error *error);

#endif
