/* Settings of the view splat: keys, names and defaults, and the passes that settings need. */
#ifndef RENDER_VIEWS_SPLAT_SPLAT_H
#define RENDER_VIEWS_SPLAT_SPLAT_H

#include "render/frame/view.h"
#include "sim/base/base.h"

typedef enum SplatWeights { SPLAT_NO_WEIGHTS, SPLAT_W1, SPLAT_W1W2, SPLAT_W2 } SplatWeights;
typedef enum SplatShape { SPLAT_PERSPECTIVE, SPLAT_PAPER, SPLAT_ELLIPSOID, SPLAT_SHAPE_AUTO } SplatShape;
typedef enum SplatSprite { SPLAT_AUTO, SPLAT_QUAD, SPLAT_POINT } SplatSprite;
typedef enum SplatShading { SPLAT_PHONG, SPLAT_WATER, SPLAT_JELLY } SplatShading;
typedef enum SplatShow {
    SPLAT_SHADED,
    SPLAT_DEPTH,
    SPLAT_NORMALS,
    SPLAT_WEIGHT,
    SPLAT_THICKNESS,
    SPLAT_CULLED
} SplatShow;

typedef enum SplatFilter { SPLAT_NO_FILTER, SPLAT_NARROW_RANGE, SPLAT_FILTER_AUTO } SplatFilter;

typedef struct MAY_ALIAS SplatDef {
    double eps; /* depth below the surface to which spheres blend, in radii */
    SplatWeights weights;
    SplatShape shape;
    SplatSprite sprite;
    SplatShow show;
    bool cull;  /* leave out hidden spheres before they are drawn */
    bool drops; /* a particle with few neighbours shrinks to a drop of its own volume */
    SplatShading shading;
    double ior;         /* refractive index of water and jelly */
    double attenuation; /* distance at which white light takes the fluid's colour, m; 0: two fifths of the
                           box's longest side, in two dimensions the layer's depth */
    double level;       /* the surface's level of the field, 0 .. 1; 0: the union of the spheres */
    SplatFilter filter;
    double filter_size;    /* half the kernel's width, in radii */
    double filter_range;   /* depths farther apart belong to two surfaces, in radii */
    int filter_iterations; /* each iteration is one pass along x and one along y */
    bool antialias;        /* smooth outlines, and spheres smaller than a pixel */
    bool sized; /* not a key: sizes of spheres depend on a scalar (ViewDef.size); set when a view is made */
} SplatDef;

extern const ViewKind view_splat;

/* The splat settings of a def; not const, like memchr's result. */
static inline SplatDef *splat_def(const ViewDef *def)
{
    return view_own_settings(def, &view_splat);
}

extern const SplatDef splat_usual; /* the defaults */
extern const Key splat_keys[];     /* ended by a row without a path */
extern const ViewGrade splat_grades[];

/* Names of the enums, ended by NULL. */
extern const char *const splat_weights_names[];
extern const char *const splat_shape_names[];
extern const char *const splat_sprite_names[];
extern const char *const splat_show_names[];
extern const char *const splat_shading_names[];
extern const char *const splat_filter_names[];

/* The meaning of `auto`: spheres; for clear fluid or full blending (w1w2) a smooth surface, unless a level
   is drawn. */
SplatShape splat_shape(const SplatDef *def);
SplatFilter splat_filter(const SplatDef *def);

/* The settings that a view is made for: the def's own, with `auto` resolved, and `sized` set. At a level
   above zero all spheres have one size. */
SplatDef splat_def_resolved(const ViewDef *def);

/* True if spheres are culled, or if the picture shows the culled spheres. */
bool splat_culls(const SplatDef *def);

/* All false at a level above zero, where particles are spheres in a field. */
bool ellipsoids_wanted(const SplatDef *def);
bool ellipsoids_stretched(const SplatDef *def); /* true: more than drops or sizes */
bool ellipsoids_crowded(const SplatDef *def);   /* true: shapes depend on neighbours, not on sizes alone */

/* True for transparent fluid: water and jelly. */
bool splat_is_clear(const SplatDef *def);

/* True if the surface ends flat at the walls of the box: clear fluid, and filtered ellipsoids. */
bool splat_has_panes(const SplatDef *def);

/* True if isolated particles are drawn separately from the surface: render/views/splat/splat_private.h. */
bool splat_has_spray(const SplatDef *def);

/* True if outlines are smoothed by discs. Then pass 2 stores the discs, and the fraction of a pixel that
   spheres smaller than pixels cover (DISCS in shaders). */
bool silhouette_by_discs(const SplatDef *def);

/* True if outlines are smoothed: not in pictures of stages before shading. */
bool silhouette_wanted(const SplatDef *def);

/* True if the view draws a level; false if the picture shows culled spheres. */
bool splat_level_wanted(const SplatDef *def);

/* True if the thickness of the fluid is part of the picture. */
bool splat_shade_wants_thickness(const SplatDef *def);

#endif
