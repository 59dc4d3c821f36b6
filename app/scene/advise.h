/* What a scene says that has no effect or will not hold, though nothing in it is wrong: lines for the user.
 */
#ifndef SLOSH_SCENE_ADVISE_H
#define SLOSH_SCENE_ADVISE_H

#include "app/base/notes.h"
#include "app/scene/scene.h"
#include "app/yaml/tree.h"

/* Adds a line to `notes` for each such setting of a scene that was read and checked. `tree` is what it was
   read from, so that a line begins with "file:line:column: "; NULL, for a scene whose keys changed while it
   runs: then lines begin with the key's path. */
void scene_advise(const Tree *tree, const Scene *scene, Notes *notes);

/* Puts a speed of sound and substeps that fit the scene in the place of defaults that do not, and says so.
   What the scene, the command line or a preset names stays. The spacing is the final one. */
void scene_fit_step(const Tree *tree, Scene *scene, Notes *notes);

/* The same of settings without effect, since what reads them is not in use: the keys that stand in `tree`,
   with their rows' owners. These lines come first in `notes`, and last as long as the scene does. */
void scene_advise_unused(const Tree *tree, const Scene *scene, Notes *notes);

/* The same of one key that is set while the scene runs. */
void scene_unused(const Scene *scene, const char *path, Notes *notes);

/* A check: asks the scene and adds its lines. */
typedef void Advice(const Tree *tree, const Scene *scene, Notes *notes);

/* Fills of few layers, and fluids of which the lattice has another mass than their fills. */
Advice advise_fills;

/* For the checks: a line about the setting at `path`, with its place where the tree has it. */
void advise(const Tree *tree, const char *path, Notes *notes, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

#endif
