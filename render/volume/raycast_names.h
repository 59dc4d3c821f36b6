/* The settings of raycasting by their names, and their defaults. */
#ifndef SLOSH_RAYCAST_NAMES_H
#define SLOSH_RAYCAST_NAMES_H

#include "render/frame/view_def.h"

extern const char *const raycast_look_names[]; /* by RaycastLook */

RaycastDef raycast_def_default(void);

/* Whether the rays of both differ in numbers only: these are read anew for each picture. */
bool raycast_same_kind(const Subject *a, const Subject *b);

#endif
