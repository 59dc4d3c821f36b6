/* Changes a scene while the simulation runs: settings from the panel and from recorded commands. */
#ifndef SLOSH_SCENE_LIVE_H
#define SLOSH_SCENE_LIVE_H

#include "app/scene/scene.h"

/* Sets a key that may change while the simulation runs (KEY_LIVE in app/scene/keys.h), in a scene that was
   read and checked: "gravity=[0, -3, 0]", "view.range=auto", "fluids[1].viscosity=0.2". Types, ranges, cross
   checks and messages ("--set path=value: ...") are those of `--set`. The camera's keys need a scene with a
   fixed camera. `concerns_world` (may be NULL) is set to true if a solver reads the key: then call
   world_change. Returns false with the reason: scene and *concerns_world are unchanged. */
bool scene_set_live(Scene *scene, const char *setting, bool *concerns_world, Error *error);

#endif
