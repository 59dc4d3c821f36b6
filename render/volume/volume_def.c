#include "render/volume/volume_def.h"

#include "sim/base/key_rows.h"

const char *const volume_bounds_names[] = {[VOLUME_BOX] = "box", [VOLUME_FLUID] = "fluid", NULL};
const char *const volume_method_names[] = {
    [VOLUME_AUTO] = "auto",     [VOLUME_GEOMETRY] = "geometry", [VOLUME_LAYERS] = "layers",
    [VOLUME_PLANES] = "planes", [VOLUME_SCATTER] = "scatter",   [VOLUME_GATHER] = "gather",
    [VOLUME_SLABS] = "slabs",   [VOLUME_DIRECT] = "direct",     NULL};
const char *const volume_show_names[] = {[VOLUME_SHADED] = "shaded",   [VOLUME_SLICE] = "slice",
                                         [VOLUME_ENTRY] = "entry",     [VOLUME_EXIT] = "exit",
                                         [VOLUME_LENGTH] = "length",   [VOLUME_STEPS] = "steps",
                                         [VOLUME_NORMALS] = "normals", NULL};
const char *const volume_solids_names[] = {
    [VOLUME_SOLIDS_SURFACE] = "surface", [VOLUME_SOLIDS_VOXELS] = "voxels", NULL};
const char *const volume_axis_names[] = {"x", "y", "z", NULL};
const char *const raycast_look_names[] = {
    [RAYCAST_OPAQUE] = "opaque", [RAYCAST_WATER] = "water", [RAYCAST_TRANSLUCENT] = "translucent", NULL};

/* Above the ramp, inside the fluid, the last y applies. */
const ControlPreset volume_presets[] = {{"ramp", {2, {0, 1}, {0, 1}}},
                                        {"fog", {2, {0, 1}, {0, 0.2}}},
                                        {"surface", {4, {0, 0.45, 0.55, 1}, {0, 0, 1, 1}}},
                                        {"shell", {4, {0, 0.3, 0.7, 1}, {0, 1, 1, 0}}},
                                        {NULL, {0}}};

const VolumeDef volume_usual = {
    .cells = 128,
    .slice_axis = 2,
    .slice = 0.5,
    .raycast = {.level = 0.5, /* the field at a plane surface: the fluid fills half the space */
                .step = 1,
                .threshold = 0.99, /* the rest is 2 of 255 */
                .ramp = {0.35, 0.65},
                .opacity = 0.04,
                .skin = 0.4,
                .curve = {2, {0, 1}, {0, 1}},
                .ior = 1.333,
                .shadows = true,
                .jitter = true,
                .skip = true}};

#define AT(field) offsetof(VolumeDef, field)

/* clang-format off */
const Key volume_keys[] = {
    MAPPING("view.volume", "of the view volume: the fluid's field on a grid of voxels"),
    INTEGER("view.volume.cells", L, 4, 4096, AT(cells), "along the box's longest side, where cell is 0; cells are never wider than the support radius"),
    NUMBER("view.volume.cell", L, "spacings", 0, 10, AT(cell), "side of a cell; 0: by cells"),
    CHOICE_OF("view.volume.bounds", L | KEY_INDEX, volume_bounds_names, AT(bounds),
           "of the volume: the box's, or those that the fluid has in each picture"),
    CHOICE_OF("view.volume.method", L | KEY_INDEX | KEY_REBUILD, volume_method_names, AT(method),
           "how the volume is made: see docs/views/volume.md; direct: none, the field is summed where it is sampled"),
    CHOICE_OF("view.volume.show", L | KEY_INDEX | KEY_REBUILD, volume_show_names, AT(show), "a stage of the way to the picture"),
    CHOICE_OF("view.volume.solids", L | KEY_INDEX | KEY_REBUILD, volume_solids_names, AT(solids),
           "how solids are drawn: their surfaces as in other views, or voxels as the fluid's, by raycasting"),
    CHOICE_OF("view.volume.slice_axis", L | KEY_INDEX, volume_axis_names, AT(slice_axis),
           "what the slice shown lies across"),
    NUMBER("view.volume.slice", L, "", 0, 1, AT(slice), "where the slice is along that axis of the box"),
    CHOICE_OF("view.volume.look", L | KEY_INDEX | KEY_REBUILD, raycast_look_names, AT(raycast.look),
           "opaque: a surface; water: one that bends what is behind and mirrors the sky; translucent: by the transfer function, which is the next five"),
    NUMBER("view.volume.opacity", L, "", 0, 1, AT(raycast.opacity), "full opacity: of fluid one spacing deep"),
    NUMBER("view.volume.skin", L, "", 0, 1, AT(raycast.skin), "opacity of each surface that a ray crosses"),
    NUMBER("view.volume.ramp_from", L, "", 0, 10, AT(raycast.ramp[0]), "the field at which opacity begins"),
    NUMBER("view.volume.ramp_to", L, "", 0, 10, AT(raycast.ramp[1]), "and at which it is full; not above: at once"),
    POINTS("view.volume.curve", L, 0, 1, volume_presets, AT(raycast.curve),
           "the share of the full opacity, by where the field is between these two; the skin goes with its ups and downs"),
    NUMBER("view.volume.level", L | O, "", 0, 10, AT(raycast.level),
           "of the field, where the surface of opaque and water is; a fluid that ends at a plane has 0.5 there"),
    NUMBER("view.volume.ior", L, "", 1, 3, AT(raycast.ior), "index of refraction, of water"),
    NUMBER("view.volume.attenuation", L, "m", 0, 1e5, AT(raycast.attenuation),
           "of water: through which white light becomes the fluid's colour; 0: two fifths of the box's longest side"),
    NUMBER("view.volume.step", L | O, "cells", 0, 10, AT(raycast.step), "between two samples of a ray"),
    NUMBER("view.volume.threshold", L | O, "", 0, 1, AT(raycast.threshold), "opacity at which a ray ends; 1: never"),
    BOOLEAN("view.volume.shadows", L | KEY_REBUILD, AT(raycast.shadows), "of the fluid on itself by marching to the light, instead of the shadow map"),
    BOOLEAN("view.volume.jitter", L, AT(raycast.jitter), "start rays at different parts of a step, so that no bands show"),
    BOOLEAN("view.volume.skip", L, AT(raycast.skip), "cast rays between the faces of what is occupied; else of the whole volume"),
    KEYS_END,
};
/* clang-format on */

const ViewGrade volume_grades[] = {
    {"view.volume.cells", {"24", "48", "96", "192"}, "view.volume.cell", "0", false},
    {"view.volume.method", {"geometry", "layers", "planes", "scatter", "gather", "slabs"}, NULL, NULL, true},
    {"view.volume.step", {"4", "2", "1", "0.5", "0.25"}, NULL, NULL, false},
    {"view.volume.threshold", {"0.9", "0.99", "0.999"}, NULL, NULL, false},
    {"view.volume.shadows", {"false", "true"}, NULL, NULL, false},
    {"view.volume.jitter", {"true", "false"}, NULL, NULL, false},
    {"view.volume.skip", {"false", "true"}, NULL, NULL, true},
    {0},
};

VolumeOpacity volume_opacity(const ViewDef *def)
{
    const VolumeDef *own = volume_def(def);
    if (def->opacity.by == 0 || own->raycast.look != RAYCAST_TRANSLUCENT || own->show != VOLUME_SHADED)
        return VOLUME_EVEN;
    return scalar_of_curve(&def->opacity) == view_color_by(def) && view_color_by(def) != SCALAR_FLUID
               ? VOLUME_BY_COLOR
               : VOLUME_BY_OWN;
}

VolumeDef *volume_def(const ViewDef *def)
{
    return view_own(def, &view_volume);
}
