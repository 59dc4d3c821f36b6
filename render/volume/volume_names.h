/* The settings of the view volume by their names, and their defaults. */
#ifndef SLOSH_VOLUME_NAMES_H
#define SLOSH_VOLUME_NAMES_H

#include "render/frame/view_def.h"

/* By their enums. */
extern const char *const volume_bounds_names[], *const volume_method_names[], *const volume_show_names[],
                                                                                  *const volume_axis_names[];

VolumeDef volume_def_default(void);

/* Whether they differ in numbers only: these a view reads anew for each picture. */
bool volume_same_kind(const VolumeDef *a, const VolumeDef *b);

#endif
