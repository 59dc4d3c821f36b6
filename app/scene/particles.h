/* `--particles N`: the spacing that gives about N particles. */
#ifndef SLOSH_SCENE_PARTICLES_H
#define SLOSH_SCENE_PARTICLES_H

#include "app/scene/scene.h"
#include "app/yaml/tree.h"

/* Sets the scene's spacing, and scales a fixed dt, or the max_dt of a method without sound, unless set by
   --set; `notes` gets a line about the change. Returns false if no spacing gives the count. */
bool scene_set_particles(const Tree *tree, Scene *scene, const SceneSettings *settings, Notes *notes,
                         Error *error);

#endif
