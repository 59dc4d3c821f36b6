#include "render/frame/view_def.h"

ViewDef view_def_shared(void)
{
    return (ViewDef){.color_by = SCALAR_COUNT,
                     .colormap = "auto",
                     .range_auto = true,
                     .color_curve = control_points_straight(),
                     .opacity = {.range_auto = true, .curve = control_points_straight()},
                     .size = {.range_auto = true, .curve = control_points_straight()},
                     .carries_scene = true,
                     .legend = true,
                     .box = true,
                     .caustics = true,
                     .foam = 1,
                     .floor = true,
                     .camera_auto = true,
                     .camera = {.fov_deg = 32},
                     .background = {0.72, 0.76, 0.80},
                     .resolution = 1};
}

static uint64_t curve_bit(const ScalarCurve *curve)
{
    return curve->by != 0 && curve->range_auto ? UINT64_C(1) << scalar_of_curve(curve) : 0;
}

uint64_t view_def_ranges(const ViewDef *def)
{
    const bool color = view_color_by(def) != SCALAR_FLUID && def->range_auto;
    return (color ? UINT64_C(1) << view_color_by(def) : 0) | curve_bit(&def->size) | curve_bit(&def->opacity);
}
