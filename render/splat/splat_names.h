/* The settings of the view splat by their names, and their defaults. */
#ifndef SLOSH_SPLAT_NAMES_H
#define SLOSH_SPLAT_NAMES_H

#include "render/frame/view_def.h"

/* By their enums. */
extern const char *const splat_weights_names[];
extern const char *const splat_shape_names[];
extern const char *const splat_sprite_names[];
extern const char *const splat_show_names[];
extern const char *const splat_shading_names[];
extern const char *const splat_filter_names[];

SplatDef splat_def_default(void);

/* Whether they differ in numbers only: these a view reads anew for each picture. */
bool splat_same_kind(const SplatDef *a, const SplatDef *b);

#endif
