#include "render/frame/view_def.h"

ViewDef view_def_shared(void)
{
    return (ViewDef){.color_by = SCALAR_SPEED,
                     .colormap = "viridis",
                     .range_auto = true,
                     .legend = true,
                     .box = true,
                     .floor = true,
                     .camera_auto = true,
                     .camera = {.fov_deg = 32},
                     .background = {0.72, 0.76, 0.80}};
}
