/* Advice for the user: valid settings of a scene that have no effect or will not hold. */
#ifndef SLOSH_SCENE_ADVISE_H
#define SLOSH_SCENE_ADVISE_H

#include "app/base/notes.h"
#include "app/scene/scene.h"
#include "app/yaml/tree.h"

/* Adds a line to `notes` for each such setting of a checked scene. `tree` is the source of the scene, for
   lines that begin with "file:line:column: ". A NULL tree, for keys changed at run time, gives lines that
   begin with the key's path. */
void scene_advise(const Tree *tree, const Scene *scene, Notes *notes);

/* Replaces defaults of the sound speed and the substeps that do not fit the scene, and reports the change.
   Values set by the scene, the command line or a preset stay. The spacing must be final. */
void scene_fit_step(const Tree *tree, Scene *scene, Notes *notes);

/* Adds lines for settings without effect because their owner is not in use: the keys in `tree`, with the
   owners of their rows. Such lines come first in `notes`, and live as long as the scene. */
void scene_advise_unused(const Tree *tree, const Scene *scene, Notes *notes);

/* Adds a line if a key set at run time has no effect. */
void scene_unused(const Scene *scene, const char *path, Notes *notes);

/* A check: examines the scene and adds lines. */
typedef void Advice(const Tree *tree, const Scene *scene, Notes *notes);

/* Warns of thin fills, and of fluids with a mass different from their fills' mass. */
Advice advise_fills;

/* For the checks: adds a line about the setting at `path`, with its place if the tree has the key. */
void advise(const Tree *tree, const char *path, Notes *notes, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

#endif
