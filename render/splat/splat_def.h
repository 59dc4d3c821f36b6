/* The view splat's own settings: their keys, names and defaults, and which passes they ask for. */
#ifndef SLOSH_SPLAT_DEF_H
#define SLOSH_SPLAT_DEF_H

#include "render/frame/view.h"
#include "sim/base/room.h"

typedef enum SplatWeights { SPLAT_NO_WEIGHTS, SPLAT_W1, SPLAT_W1W2 } SplatWeights;
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

typedef struct IN_A_ROOM SplatDef {
    double eps; /* how far below the surface spheres still blend, in radii */
    SplatWeights weights;
    SplatShape shape;
    SplatSprite sprite;
    SplatShow show;
    bool cull;  /* leave out hidden spheres before they are drawn */
    bool drops; /* a particle with few neighbours shrinks to a drop of its own volume */
    SplatShading shading;
    double ior;         /* index of refraction, of water and jelly */
    double attenuation; /* through which white light becomes the fluid's colour, m; 0: two fifths of the
                           box's longest side, in two dimensions the layer's depth */
    double level;       /* of the field that is the surface, 0 .. 1; 0: the union of the spheres */
    SplatFilter filter;
    double filter_size;    /* half the kernel's width, in radii */
    double filter_range;   /* depths farther apart are two surfaces, in radii */
    int filter_iterations; /* each is one pass along x and one along y */
    bool antialias;        /* smooth outlines, and spheres smaller than a pixel */
    bool sized; /* no key: the size of spheres goes with a scalar (ViewDef.size); set where a view is made */
} SplatDef;

extern const ViewKind view_splat;

/* Those of that def; not const, as memchr's result is not. */
SplatDef *splat_def(const ViewDef *def);

extern const SplatDef splat_usual; /* the defaults */
extern const Key splat_keys[];     /* ended by a row without a path */
extern const ViewGrade splat_grades[];

/* By their enums, ended by NULL. */
extern const char *const splat_weights_names[];
extern const char *const splat_shape_names[];
extern const char *const splat_sprite_names[];
extern const char *const splat_show_names[];
extern const char *const splat_shading_names[];
extern const char *const splat_filter_names[];

/* What `auto` stands for: spheres, but for clear fluid a smooth surface, unless a level is one already. */
SplatShape splat_shape(const SplatDef *def);
SplatFilter splat_filter(const SplatDef *def);

/* What a view is made for: the def's own settings, with what `auto` stands for, and whether they are sized.
   At a level above zero spheres have one size. */
SplatDef splat_def_made(const ViewDef *def);

/* Whether spheres are culled: also where the picture shows what culling left out. */
bool splat_culls(const SplatDef *def);

/* What culling left out is shown of the spheres, not of a level. */
bool splat_level_wanted(const SplatDef *def);

/* Neither at a level of the field above zero, which has a shape of its own: particles are spheres there. */
bool ellipsoids_wanted(const SplatDef *def);
bool ellipsoids_stretched(const SplatDef *def); /* not drops or sizes alone */
bool ellipsoids_crowded(const SplatDef *def);   /* by their neighbours: not sizes alone */

bool splat_shade_wants_thickness(const SplatDef *def);

/* Whether one sees through the fluid: water and jelly. */
bool splat_clear(const SplatDef *def);

/* Whether particles on their own are drawn apart from the surface: render/splat/spray.h. */
bool splat_sprays(const SplatDef *def);

/* Whether outlines are smoothed: pictures of what comes before shading are left as they are. */
bool silhouette_wanted(const SplatDef *def);

/* Whether by discs; then pass 2 keeps them, and what spheres smaller than pixels cover of these (DISCS in
 * shaders). */
bool silhouette_by_discs(const SplatDef *def);

/* ViewKind.same. */
bool splat_same(const Subject *a, const Subject *b);

#endif
