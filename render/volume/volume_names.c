#include "render/volume/volume_names.h"

const char *const volume_bounds_names[] = {[VOLUME_BOX] = "box", [VOLUME_FLUID] = "fluid"};
const char *const volume_method_names[] = {
    [VOLUME_AUTO] = "auto",     [VOLUME_GEOMETRY] = "geometry", [VOLUME_LAYERS] = "layers",
    [VOLUME_PLANES] = "planes", [VOLUME_SCATTER] = "scatter",   [VOLUME_GATHER] = "gather",
    [VOLUME_SLABS] = "slabs",   [VOLUME_DIRECT] = "direct"};
const char *const volume_show_names[] = {
    [VOLUME_SHADED] = "shaded", [VOLUME_SLICE] = "slice", [VOLUME_ENTRY] = "entry",    [VOLUME_EXIT] = "exit",
    [VOLUME_LENGTH] = "length", [VOLUME_STEPS] = "steps", [VOLUME_NORMALS] = "normals"};
const char *const volume_axis_names[] = {"x", "y", "z"};

VolumeDef volume_def_default(void)
{
    return (VolumeDef){.cells = 128, .slice_axis = 2, .slice = 0.5};
}

bool volume_same_kind(const VolumeDef *a, const VolumeDef *b)
{
    return a->method == b->method && a->show == b->show;
}
