/* Cross checks: the values of a scene must fit each other and the machine. */
#ifndef SLOSH_SCENE_CHECK_H
#define SLOSH_SCENE_CHECK_H

#include "app/scene/scene.h"
#include "app/yaml/tree.h"

/* Checks all that needs no particle count: fluids inside the box, unique names, axes with a direction, ...
   The error points at the node of the wrong value. */
bool scene_check(const Tree *tree, const Scene *scene, Error *error);

/* Checks that each fluid has particles, and that all fit into the machine's memory. */
bool scene_check_count(const Tree *tree, const Scene *scene, Error *error);

/* True if counting the particles at this spacing is fast; otherwise the error has the reason. */
bool scene_check_bounds(const Tree *tree, const Scene *scene, double spacing, Error *error);

/* True if this machine can hold so many particles. */
bool scene_fits_memory(double particles);

/* Volume in m3; overlaps count twice. */
double scene_fluid_volume(const Scene *scene);

/* The least thickness of a solid, m. */
double scene_solid_width(const SolidDef *solid, int dimensions);

#endif
