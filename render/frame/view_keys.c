/* Picture keys that all views share. */
#include "render/frame/colormap.h"
#include "render/frame/view.h"
#include "render/frame/view_def.h"
#include "sim/base/control_points.h"
#include "sim/base/key_rows.h"
#include "sim/base/scalar.h"

#define AT(field) offsetof(ViewDef, field)

const char *const view_walls_names[] = {
    [VIEW_WALLS_AUTO] = "auto", [VIEW_WALLS_LINES] = "lines", [VIEW_WALLS_GLASS] = "glass", NULL};

/* The views, then "none". */
static const char *kind_name(int index)
{
    int views = 0;
    while (view_at(views))
        views++;
    return index < views ? view_at(index)->name : index == views ? "none" : NULL;
}

#define SYMMETRIC_FOLLOWS(range_of)                                                                          \
    _Static_assert(offsetof(ViewDef, range_of##_symmetric) == offsetof(ViewDef, range_of##_auto) + 1,        \
                   "bool[2] of KEY_RANGE")
SYMMETRIC_FOLLOWS(range);
SYMMETRIC_FOLLOWS(opacity.range);
SYMMETRIC_FOLLOWS(size.range);

const char *const view_quality_names[] = {
    [VIEW_AUTO] = "auto", [VIEW_DRAFT] = "draft", [VIEW_GOOD] = "good", [VIEW_BEST] = "best", NULL};

/* The scalars, then "auto". */
static const char *scalar_or_auto(int index)
{
    return index < SCALAR_COUNT ? scalar_list[index].name : index == SCALAR_COUNT ? "auto" : NULL;
}

/* "none", then the scalars. */
static const char *scalar_or_none(int index)
{
    return index == 0 ? "none" : scalar_list[index - 1].name;
}

static const KeyOwner by_opacity = {.key = "view.opacity.by", .need = "a scalar (view.opacity.by)"};
static const KeyOwner by_size = {.key = "view.size.by", .need = "a scalar (view.size.by)"};

#define KEYFRAME(field) offsetof(CameraKey, field)

static void camera_key_init(void *element, int index)
{
    (void)index;
    ((CameraKey *)element)->at.fov_deg = view_def_shared().camera.fov_deg;
}

/* clang-format off */
const Key view_keys[] = {
    MAPPING("view", "the picture", .flags = I),
    CHOICE("view.kind", L, kind_name, AT(kind), "how the fluid is drawn"),
    CHOICE("view.color_by", L | KEY_INDEX, scalar_or_auto, AT(color_by), "what the colour shows; auto: the fluid's own colour where the view shows clear fluid (looks and shadings water and jelly), else speed"),
    CHOICE_OF("view.colormap", L, colormap_choices, AT(colormap), "the colours of a scalar; auto: mako of speed, viridis of all else"),
    {.path = "view.range", .type = KEY_RANGE, .flags = L, .unit = "", BOUNDS(-1e12, 1e12), .offset = AT(range),
     .aux = AT(range_auto), .help = "auto: of 98 in 100 particles; symmetric: that, about 0; or [low, high] in the scalar's unit; auto where view.color_by is set to another scalar than the file's"},
    POINTS("view.color_curve", L, 0, 1, control_presets, AT(color_curve), "bends the colormap: the place in it by where the scalar is in its range"),
    MAPPING("view.opacity", "of particles, by a scalar"),
    CHOICE("view.opacity.by", L | KEY_INDEX, scalar_or_none, AT(opacity.by), "the scalar; none: all are opaque"),
    {.path = "view.opacity.range", .type = KEY_RANGE, .flags = L, .unit = "", BOUNDS(-1e12, 1e12), .offset = AT(opacity.range),
     .aux = AT(opacity.range_auto), .owner = &by_opacity, .help = "auto, symmetric or [low, high] in the scalar's unit, as view.range"},
    POINTS("view.opacity.curve", L, 0, 1, control_presets, AT(opacity.curve), "the opacity by where the scalar is in its range", .owner = &by_opacity),
    MAPPING("view.size", "of particles, by a scalar"),
    CHOICE("view.size.by", L | KEY_INDEX, scalar_or_none, AT(size.by), "the scalar; none: all are of one radius"),
    {.path = "view.size.range", .type = KEY_RANGE, .flags = L, .unit = "", BOUNDS(-1e12, 1e12), .offset = AT(size.range),
     .aux = AT(size.range_auto), .owner = &by_size, .help = "auto, symmetric or [low, high] in the scalar's unit, as view.range"},
    POINTS("view.size.curve", L, 0, 5, control_presets, AT(size.curve), "factor of view.radius by where the scalar is in its range", .owner = &by_size),
    NUMBER("view.radius", L, "spacings", 0, 10, AT(radius), "of a particle; 0: the view's own"),
    KEYS_END,
};

/* Keys that the docs list after the views' own keys. */
const Key view_frame_keys[] = {
    BOOLEAN("view.legend", L, AT(legend), "draw the legend"),
    BOOLEAN("view.box", L, AT(box), "draw the box's edges"),
    CHOICE_OF("view.walls", L | KEY_INDEX, view_walls_names, AT(walls), "how the box is drawn: lines: its edges; glass: edges that catch the light, panes that mirror faintly and a line where water meets them (a draft has the edges alone); auto: glass where the view shows clear fluid, else lines"),
    BOOLEAN("view.floor", L, AT(floor), "draw the floor below the box"),
    COLOR("view.background", L, AT(background), NULL, "sRGB: [red, green, blue], each 0 to 1"),
    BOOLEAN("view.caustics", L, AT(caustics), "light patterns on the floor below clear fluid; never in a draft"),
    NUMBER("view.foam", L, "", 0, 10, AT(foam), "white foam where clear fluid traps air: 1 where it does so at metres a second, 2 at half the speed, 0 none; never in a draft"),
    {.path = "view.camera", .type = KEY_MAPPING, .unit = "", .offset = KEY_NOWHERE, .aux = AT(camera_auto),
     .help = "the camera; without it, one that shows the whole box"},
    VEC3("view.camera.from", R | L, "m", -1e7, 1e7, AT(camera.from), "the eye, in the world's frame"),
    VEC3("view.camera.to", R | L, "m", -1e7, 1e7, AT(camera.to), "the point looked at"),
    NUMBER("view.camera.fov", L, "degrees", 1, 170, AT(camera.fov_deg), "vertical field of view"),
    NUMBER("view.camera_turn", L, "degrees/s", -3600, 3600, AT(camera_turn), "turns the camera about the vertical through what it looks at, in simulated time"),
    LIST("view.camera_path", 0, 0, CAMERA_KEYS_MAX, AT(camera_path), AT(camera_path_count), CameraKey, camera_key_init,
         "where the camera flies, in simulated time: keyframes, with a smooth curve through them; it rests at the first one before, at the last one after"),
    NUMBER("view.camera_path[].time", R, "s", 0, 1e6, KEYFRAME(time), "later than that of the one before"),
    VEC3("view.camera_path[].from", R, "m", -1e7, 1e7, KEYFRAME(at.from), "the eye then"),
    VEC3("view.camera_path[].to", R, "m", -1e7, 1e7, KEYFRAME(at.to), "the point looked at"),
    NUMBER("view.camera_path[].fov", 0, "degrees", 1, 170, KEYFRAME(at.fov_deg), "vertical field of view"),
    TEXT("view.title", L, VIEW_TITLE_SIZE, AT(title), "none", "words over the picture"),
    BOOLEAN("view.carries_scene", L, AT(carries_scene), "PNG files carry the scene as text: slosh FILE.png opens it again"),
    CHOICE_OF("view.quality", L | KEY_INDEX, view_quality_names, AT(quality), "draft: fewer cells, pixels and samples, so that a picture is there in time; good: as all keys say; best: more; what is not at its default stays; auto: best in files, draft for clear fluid and filtered splats in the window on a software driver, else good"),
    NUMBER("view.resolution", L, "", 0.05, 1, AT(resolution), "pixels drawn for a pixel shown, each way: less is faster; the box's edges, words and the legend have all of them"),
    TEXT("view.file", 0, FILE_NAME_SIZE, AT(file), "none", "of an entry of views: it shows a recorded run (.h5part, found from the scene's folder) at the scene's time"),
    SETTINGS("view.set", VIEW_SET_SIZE, AT(set), "none", "of an entry of views: it shows the scene with these settings, {solver.step.dt: 0.001} and so on, simulated beside it"),
    KEYS_END,
};
/* clang-format on */
