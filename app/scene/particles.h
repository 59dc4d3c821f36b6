/* `--particles N`: the spacing that gives about N particles. */
#ifndef SLOSH_SCENE_PARTICLES_H
#define SLOSH_SCENE_PARTICLES_H

#include "app/scene/scene.h"
#include "app/yaml/tree.h"

/* Sets the scene's spacing, and scales a fixed dt with it, or the max_dt of a method without sound, unless
   that was given by --set; `notes` gets the sentence that says so. False when no spacing gives so many. */
bool scene_set_particles(const Tree *tree, Scene *scene, const SceneSettings *settings, Notes *notes,
                         Error *error);

#endif
