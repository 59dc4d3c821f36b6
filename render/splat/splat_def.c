#include "render/splat/splat_def.h"

const char *const splat_weights_names[] = {
    [SPLAT_NO_WEIGHTS] = "none", [SPLAT_W1] = "w1", [SPLAT_W1W2] = "w1w2"};
const char *const splat_shape_names[] = {
    [SPLAT_PERSPECTIVE] = "perspective", [SPLAT_PAPER] = "paper", [SPLAT_ELLIPSOID] = "ellipsoid"};
const char *const splat_sprite_names[] = {
    [SPLAT_AUTO] = "auto", [SPLAT_QUAD] = "quad", [SPLAT_POINT] = "point"};
const char *const splat_show_names[] = {
    [SPLAT_SHADED] = "shaded", [SPLAT_DEPTH] = "depth",         [SPLAT_NORMALS] = "normals",
    [SPLAT_WEIGHT] = "weight", [SPLAT_THICKNESS] = "thickness", [SPLAT_CULLED] = "culled"};
const char *const splat_shading_names[] = {
    [SPLAT_PHONG] = "phong", [SPLAT_WATER] = "water", [SPLAT_JELLY] = "jelly"};

const char *const splat_filter_names[] = {[SPLAT_NO_FILTER] = "none", [SPLAT_NARROW_RANGE] = "narrow_range"};

SplatDef splat_def_default(void)
{
    return (SplatDef){.eps = 1.5,
                      .weights = SPLAT_W1W2,
                      .cull = true,
                      .drops = true,
                      .ior = 1.333,
                      .filter_size = 4,
                      .filter_range = 3,
                      .filter_iterations = 2,
                      .antialias = true};
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
    return def->shape == SPLAT_ELLIPSOID && !(def->level > 0);
}

bool ellipsoids_wanted(const SplatDef *def)
{
    return ellipsoids_stretched(def) || (def->drops && !(def->level > 0));
}

bool splat_shade_wants_thickness(const SplatDef *def)
{
    return def->show == SPLAT_THICKNESS || (def->show == SPLAT_SHADED && def->shading != SPLAT_PHONG);
}

bool silhouette_wanted(const SplatDef *def)
{
    return def->antialias && (def->show == SPLAT_SHADED || def->show == SPLAT_CULLED);
}

bool silhouette_by_discs(const SplatDef *def)
{
    return silhouette_wanted(def) && !splat_level_wanted(def);
}

bool splat_same(const Subject *one, const Subject *other)
{
    const SplatDef *a = &one->def->splat, *b = &other->def->splat;
    return a->weights == b->weights && a->shape == b->shape && a->sprite == b->sprite && a->show == b->show &&
           a->cull == b->cull && a->drops == b->drops && a->shading == b->shading &&
           (a->level > 0) == (b->level > 0) && a->filter == b->filter && a->antialias == b->antialias;
}
