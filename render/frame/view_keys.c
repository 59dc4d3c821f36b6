/* Keys of the picture, whichever the view. */
#include "render/frame/colormap.h"
#include "render/frame/view.h"
#include "render/frame/view_def.h"
#include "sim/base/key_rows.h"
#include "sim/base/scalar.h"

#define AT(field) offsetof(ViewDef, field)

/* The views, then "none". */
static const char *kind_name(int index)
{
    int views = 0;
    while (view_at(views))
        views++;
    return index < views ? view_at(index)->name : index == views ? "none" : NULL;
}

_Static_assert(offsetof(ViewDef, range_symmetric) == offsetof(ViewDef, range_auto) + 1,
               "bool[2] of KEY_RANGE");

/* clang-format off */
const Key view_keys[] = {
    MAPPING("view", "the picture", .flags = I),
    CHOICE("view.kind", L, kind_name, AT(kind), "how the fluid is drawn"),
    CHOICE_OF("view.color_by", L | KEY_INDEX, scalar_list, AT(color_by), "what the colour shows"),
    CHOICE_OF("view.colormap", L, colormap_list, AT(colormap), "the colours of a scalar"),
    {.path = "view.range", .type = KEY_RANGE, .flags = L, .unit = "", BOUNDS(-1e12, 1e12), .offset = AT(range),
     .aux = AT(range_auto), .help = "auto: of 98 in 100 particles; symmetric: that, about 0; or [low, high] in the scalar's unit; auto where view.color_by is set to another scalar than the file's"},
    NUMBER("view.radius", L, "spacings", 0, 10, AT(radius), "of a particle; 0: the view's own"),
    KEYS_END,
};

/* Those that people see behind the views' own. */
const Key view_frame_keys[] = {
    BOOLEAN("view.legend", L, AT(legend), "draw the legend"),
    BOOLEAN("view.box", L, AT(box), "draw the box's edges"),
    BOOLEAN("view.floor", L, AT(floor), "draw the floor below the box"),
    COLOR("view.background", L, AT(background), NULL, "sRGB: [red, green, blue], each 0 to 1"),
    {.path = "view.camera", .type = KEY_MAPPING, .unit = "", .offset = KEY_NOWHERE, .aux = AT(camera_auto),
     .help = "the camera; without it, one that shows the whole box"},
    VEC3("view.camera.from", R | L, "m", -1e5, 1e5, AT(camera.from), "the eye, in the world's frame"),
    VEC3("view.camera.to", R | L, "m", -1e5, 1e5, AT(camera.to), "the point looked at"),
    NUMBER("view.camera.fov", L, "degrees", 1, 170, AT(camera.fov_deg), "vertical field of view"),
    KEYS_END,
};
/* clang-format on */
