/* The settings of the view splat: their names, their defaults, and which passes they ask for. */
#ifndef SLOSH_SPLAT_DEF_H
#define SLOSH_SPLAT_DEF_H

#include "render/frame/view_def.h"

/* By their enums. */
extern const char *const splat_weights_names[];
extern const char *const splat_shape_names[];
extern const char *const splat_sprite_names[];
extern const char *const splat_show_names[];
extern const char *const splat_shading_names[];
extern const char *const splat_filter_names[];

SplatDef splat_def_default(void);

/* To see what culling left out wants it too. */
bool splat_culls(const SplatDef *def);

/* What culling left out is shown of the spheres, not of a level. */
bool splat_level_wanted(const SplatDef *def);

/* Neither at a level of the field above zero, which has a shape of its own: particles are spheres there. */
bool ellipsoids_wanted(const SplatDef *def);
bool ellipsoids_stretched(const SplatDef *def); /* not drops alone */

bool splat_shade_wants_thickness(const SplatDef *def);

/* Whether outlines are smoothed: pictures of what comes before shading are left as they are. */
bool silhouette_wanted(const SplatDef *def);

/* Whether by discs; then pass 2 keeps them, and what spheres smaller than pixels cover of these (DISCS in
 * shaders). */
bool silhouette_by_discs(const SplatDef *def);

/* ViewKind.same. */
bool splat_same(const Subject *a, const Subject *b);

#endif
