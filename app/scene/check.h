/* What no single value shows: whether the values of a scene fit each other and the machine. */
#ifndef SLOSH_SCENE_CHECK_H
#define SLOSH_SCENE_CHECK_H

#include "app/scene/scene.h"
#include "app/yaml/tree.h"

/* Fluids inside the box, names unique, axes with a direction, ...: all that needs no particle counted. The
   message points at the node of the value at fault. */
bool scene_check(const Tree *tree, const Scene *scene, Error *error);

/* Every fluid has particles, and the machine has the memory for them all. */
bool scene_check_count(const Tree *tree, const Scene *scene, Error *error);

/* Whether counting the particles at this spacing is soon done, and why not otherwise. */
bool scene_check_bounds(const Tree *tree, const Scene *scene, double spacing, Error *error);

/* Whether this machine can hold so many particles at all. */
bool scene_fits_memory(double particles);

/* m3, overlaps counted twice. */
double scene_fluid_volume(const Scene *scene);

/* The least width of a solid's matter, m. */
double scene_solid_width(const SolidDef *solid, int dimensions);

#endif
