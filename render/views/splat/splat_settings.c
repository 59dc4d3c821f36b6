/* The settings of the view splat: keys, names, and what follows from them for a picture. */
#include "render/views/splat/splat_private.h"
#include "sim/base/key_rows.h"

const char *const splat_weights_names[] = {
    [SPLAT_NO_WEIGHTS] = "none", [SPLAT_W1] = "w1", [SPLAT_W1W2] = "w1w2", [SPLAT_W2] = "w2", NULL};
const char *const splat_shape_names[] = {[SPLAT_PERSPECTIVE] = "perspective",
                                         [SPLAT_PAPER] = "paper",
                                         [SPLAT_ELLIPSOID] = "ellipsoid",
                                         [SPLAT_SHAPE_AUTO] = "auto",
                                         NULL};
const char *const splat_sprite_names[] = {
    [SPLAT_AUTO] = "auto", [SPLAT_QUAD] = "quad", [SPLAT_POINT] = "point", NULL};
const char *const splat_show_names[] = {[SPLAT_SHADED] = "shaded",
                                        [SPLAT_DEPTH] = "depth",
                                        [SPLAT_NORMALS] = "normals",
                                        [SPLAT_WEIGHT] = "weight",
                                        [SPLAT_THICKNESS] = "thickness",
                                        [SPLAT_CULLED] = "culled",
                                        NULL};
const char *const splat_shading_names[] = {
    [SPLAT_PHONG] = "phong", [SPLAT_WATER] = "water", [SPLAT_JELLY] = "jelly", NULL};

const char *const splat_filter_names[] = {
    [SPLAT_NO_FILTER] = "none", [SPLAT_NARROW_RANGE] = "narrow_range", [SPLAT_FILTER_AUTO] = "auto", NULL};

const SplatDef splat_usual = {.eps = 1.5,
                              .weights = SPLAT_W1W2,
                              .shape = SPLAT_SHAPE_AUTO,
                              .cull = true,
                              .drops = true,
                              .ior = 1.333,
                              .filter = SPLAT_FILTER_AUTO,
                              .filter_size = 4,
                              .filter_range = 3,
                              .filter_iterations = 2,
                              .antialias = true};

#define AT(field) offsetof(SplatDef, field)

/* clang-format off */
const Key splat_keys[] = {
    MAPPING("view.splat", "of the view splat: the fluid as one surface, after Adams, Lenaerts and Dutré 2006"),
    NUMBER("view.splat.level", L, "", 0, 1, AT(level),
           "of the field that is the surface (0.1 and so on); 0: the spheres; above, radius 0 is the solver's support radius, "
           "and eps, weights, drops and ellipsoids have no part in it"),
    NUMBER("view.splat.eps", L | O, "radii", 0, 10, AT(eps), "how far below the surface spheres still blend"),
    CHOICE_OF("view.splat.weights", L | KEY_INDEX | KEY_REBUILD, splat_weights_names, AT(weights),
           "w1: a sphere's share falls to its rim; w2: with its depth; w1w2: with both; none: each pixel is its foremost sphere's"),
    CHOICE_OF("view.splat.shape", L | KEY_INDEX | KEY_REBUILD, splat_shape_names, AT(shape),
           "perspective: exact spheres; paper: circles on the screen; ellipsoid: stretched as their neighbours lie; "
           "auto: ellipsoid, but perspective with a level, and opaque with other weights than w1w2"),
    CHOICE_OF("view.splat.sprite", L | KEY_INDEX | KEY_REBUILD, splat_sprite_names, AT(sprite),
           "quad; point: a GL point, which drivers cut at some size; auto: points on a software driver while they are small, else quads"),
    CHOICE_OF("view.splat.show", L | KEY_INDEX | KEY_REBUILD, splat_show_names, AT(show), "a stage of the way to the picture"),
    CHOICE_OF("view.splat.shading", L | KEY_INDEX | KEY_REBUILD, splat_shading_names, AT(shading),
           "phong: opaque; water: clear, bends what is behind and mirrors the sky; jelly: both"),
    NUMBER("view.splat.ior", L, "", 1, 3, AT(ior), "index of refraction, of water and jelly"),
    NUMBER("view.splat.attenuation", L, "m", 0, 1e5, AT(attenuation),
           "through which white light becomes the fluid's colour; 0: two fifths of the box's longest side, in 2D a spacing"),
    BOOLEAN("view.splat.cull", L | KEY_REBUILD, AT(cull), "leave out hidden spheres before they are drawn"),
    BOOLEAN("view.splat.drops", L | KEY_REBUILD, AT(drops), "a particle with few neighbours shrinks to a drop of its own volume"),
    CHOICE_OF("view.splat.filter", L | KEY_INDEX | KEY_REBUILD, splat_filter_names, AT(filter),
           "narrow_range: smooth the depth on the screen and take the normals from it, after Truong and Yuksel 2018; "
           "auto: narrow_range where auto makes the shape ellipsoid"),
    NUMBER("view.splat.filter_size", L | O, "radii", 0, 100, AT(filter_size), "half the width of the filter"),
    NUMBER("view.splat.filter_range", L | O, "radii", 0, 100, AT(filter_range),
           "the filter takes what lies farther in front or behind for another surface"),
    INTEGER("view.splat.filter_iterations", L, 1, 20, AT(filter_iterations), "how often the filter runs"),
    BOOLEAN("view.splat.antialias", L | KEY_REBUILD, AT(antialias), "smooth outlines, and spheres smaller than pixels"),
    KEYS_END,
};
/* clang-format on */

const ViewGrade splat_grades[] = {
    {"view.splat.shape", {"paper", "auto"}, NULL, NULL, false},
    {"view.splat.sprite", {"point", "quad"}, NULL, NULL, false},
    {"view.splat.cull", {"false", "true"}, NULL, NULL, true},
    {"view.splat.filter_iterations", {"1", "2", "4"}, "view.splat.filter", "narrow_range", false},
    {"view.splat.antialias", {"false", "true"}, NULL, NULL, false},
    {0},
};

/* True if the picture is one surface: pictures of single spheres, or of a level, stay unchanged. */
static bool smooth(const SplatDef *def)
{
    return !(def->level > 0) && (def->shading != SPLAT_PHONG || def->weights == SPLAT_W1W2);
}

SplatShape splat_shape(const SplatDef *def)
{
    return def->shape != SPLAT_SHAPE_AUTO ? def->shape : smooth(def) ? SPLAT_ELLIPSOID : SPLAT_PERSPECTIVE;
}

SplatFilter splat_filter(const SplatDef *def)
{
    return def->filter != SPLAT_FILTER_AUTO ? def->filter
           : smooth(def)                    ? SPLAT_NARROW_RANGE
                                            : SPLAT_NO_FILTER;
}

SplatDef splat_def_resolved(const ViewDef *def)
{
    SplatDef made = *splat_def(def);
    made.shape = splat_shape(&made);
    made.filter = splat_filter(&made);
    made.sized = def->size.by != 0 && !(made.level > 0);
    return made;
}

bool splat_culls(const SplatDef *def)
{
    return def->cull || def->show == SPLAT_CULLED;
}

bool splat_level_wanted(const SplatDef *def)
{
    return def->level > 0 && def->show != SPLAT_CULLED;
}

bool ellipsoids_stretched(const SplatDef *def)
{
    return splat_shape(def) == SPLAT_ELLIPSOID && !(def->level > 0);
}

bool ellipsoids_crowded(const SplatDef *def)
{
    return ellipsoids_stretched(def) || (def->drops && !(def->level > 0));
}

bool ellipsoids_wanted(const SplatDef *def)
{
    return ellipsoids_crowded(def) || def->sized;
}

bool splat_shade_wants_thickness(const SplatDef *def)
{
    return def->show == SPLAT_THICKNESS || splat_is_clear(def);
}

bool splat_is_clear(const SplatDef *def)
{
    return def->show == SPLAT_SHADED && def->shading != SPLAT_PHONG;
}

bool splat_has_panes(const SplatDef *def)
{
    const bool smooth =
        def->show == SPLAT_SHADED && ellipsoids_stretched(def) && splat_filter(def) == SPLAT_NARROW_RANGE;
    return splat_is_clear(def) || smooth;
}

bool splat_has_spray(const SplatDef *def)
{
    return splat_is_clear(def) && def->drops && ellipsoids_stretched(def);
}

bool silhouette_wanted(const SplatDef *def)
{
    return def->antialias && (def->show == SPLAT_SHADED || def->show == SPLAT_CULLED);
}

/* Discs of spheres reach beyond the panes of an opaque fluid. */
bool silhouette_by_discs(const SplatDef *def)
{
    const bool flat = splat_has_panes(def) && !splat_is_clear(def);
    return silhouette_wanted(def) && !splat_level_wanted(def) && !flat;
}

const char *ellipsoids_defines(const SplatDef *def)
{
    if (ellipsoids_stretched(def))
        return splat_has_spray(def) ? ELLIPSOIDS_LEAST "#define ELLIPSOID 1\n#define APART 1\n"
                                    : ELLIPSOIDS_LEAST "#define ELLIPSOID 1\n";
    const bool paper = splat_shape(def) == SPLAT_PAPER;
    if (ellipsoids_wanted(def))
        return paper ? "#define PAPER 1\n#define DROPS 1\n" : "#define DROPS 1\n";
    return paper ? "#define PAPER 1\n" : "";
}
