/* Views: settings and keys shared by all kinds, quality, and calls of a kind's functions. */
#include "render/frame/view.h"
#include "render/frame/effect.h"
#include "render/frame/frame.h"

#include "sim/base/base.h"
#include "sim/base/key_rows.h"
#include "sim/flow/flow.h"
#include "sim/gpu/gl.h"
#include "sim/start/start.h"
#include "sim/world.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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
                     .background = {0.25, 0.285, 0.33},
                     .resolution = 1,
                     .time = -1};
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

/* Picture keys that all views share. */

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
    NUMBER("view.radius", L, "spacings", 0, 10, AT(radius), "of a particle; auto, 0: the view's own", .zero = "auto"),
    KEYS_END,
};

/* Keys that the docs list after the views' own keys. */
const Key view_frame_keys[] = {
    BOOLEAN("view.legend", L, AT(legend), "draw the legend, the time, and an arrow of gravity where that is not towards the floor"),
    BOOLEAN("view.box", L, AT(box), "draw the box's edges"),
    CHOICE_OF("view.walls", L | KEY_INDEX, view_walls_names, AT(walls), "how the box is drawn: lines: its edges; glass: edges that catch the light, panes that mirror faintly and a line where water meets them (a draft has the edges alone); auto: glass where the view shows clear fluid, else lines"),
    BOOLEAN("view.floor", L, AT(floor), "draw the floor below the box"),
    COLOR("view.background", L, AT(background), NULL, "sRGB: [red, green, blue], each 0 to 1"),
    BOOLEAN("view.caustics", L, AT(caustics), "light patterns on the floor below clear fluid; never in a draft"),
    NUMBER("view.foam", L, "", 0, 10, AT(foam), "white foam where clear fluid is turbulent: 1 where it is so at metres a second, 2 at half the speed, 0 none; never in a draft"),
    {.path = "view.camera", .type = KEY_MAPPING, .unit = "", .offset = KEY_NOWHERE, .aux = AT(camera_auto),
     .help = "the camera; without it, one that shows the whole box"},
    VEC3("view.camera.from", R | L, "m", -1e7, 1e7, AT(camera.from), "the eye, in the world's frame"),
    VEC3("view.camera.to", R | L, "m", -1e7, 1e7, AT(camera.to), "the point looked at"),
    NUMBER("view.camera.fov", L, "degrees", 1, 170, AT(camera.fov_deg), "vertical field of view"),
    NUMBER("view.camera_turn", L, "degrees/s", -3600, 3600, AT(camera_turn), "turns the camera about the vertical through what it looks at, in simulated time"),
    LIST("view.camera_path", KEY_POINTER, 0, CAMERA_KEYS_MAX, AT(camera_path), AT(camera_path_count), CameraKey, camera_key_init,
         "where the camera flies, in simulated time: keyframes, with a smooth curve through them; it rests at the first one before, at the last one after"),
    NUMBER("view.camera_path[].time", R, "s", 0, 1e6, KEYFRAME(time), "later than that of the one before"),
    VEC3("view.camera_path[].from", R, "m", -1e7, 1e7, KEYFRAME(at.from), "the eye then"),
    VEC3("view.camera_path[].to", R, "m", -1e7, 1e7, KEYFRAME(at.to), "the point looked at"),
    NUMBER("view.camera_path[].fov", 0, "degrees", 1, 170, KEYFRAME(at.fov_deg), "vertical field of view"),
    TEXT("view.title", L, VIEW_TITLE_SIZE, AT(title), "none", "words over the picture"),
    BOOLEAN("view.carries_scene", L, AT(carries_scene), "PNG files carry the scene as text: slosh FILE.png opens it again"),
    CHOICE_OF("view.quality", L | KEY_INDEX, view_quality_names, AT(quality), "draft: fewer cells, pixels and samples, so that a picture is there in time; good: as all keys say; best: more; what is not at its default stays; auto: best in files, draft for clear fluid and filtered splats in the window on a software driver, else good"),
    NUMBER("view.resolution", L, "", 0.05, 2, AT(resolution), "pixels drawn for a pixel shown, each way: below 1 is faster, and the box's edges, words and the legend keep all of them; 2: four samples of each pixel, for smooth outlines, fewer where more than 16 million would be drawn; where it is 1, best has 2, of filtered splats 1.5, and a draft of clear fluid 0.5"),
    FILE_TEXT("view.file", 0, AT(file), "none", "of an entry of views: it shows a recorded run (.h5part, found from the scene's folder) at the scene's time"),
    SETTINGS("view.set", KEY_POINTER, VIEW_SET_SIZE, AT(set), "none", "of an entry of views: it shows the scene with these settings, {solver.step.dt: 0.001} and so on, simulated beside it"),
    NUMBER("view.time", 0, "s", -1, 1e6, AT(time), "the state shown is the first at or after this simulated time, whatever time the picture has; below 0: that of the picture"),
    KEYS_END,
};
/* clang-format on */

static const ViewKind *added[VIEW_KINDS_MAX + 1];

struct View {
    const ViewKind *kind;
    void *state;
};

static int count_of(const ViewKind *const *kinds)
{
    int count = 0;
    while (kinds[count])
        count++;
    return count;
}

void view_add(const ViewKind *kind)
{
    const int count = count_of(added);
    if (view_find(kind->name) == kind)
        return;
    assert(count_of(view_list) + count < VIEW_KINDS_MAX && !view_find(kind->name));
    added[count] = kind;
}

const ViewKind *view_at(int index)
{
    const int listed = count_of(view_list);
    if (index < listed)
        return view_list[index];
    return index - listed < count_of(added) ? added[index - listed] : NULL;
}

const ViewKind *view_find(const char *name)
{
    for (int i = 0; view_at(i); i++)
        if (strcmp(view_at(i)->name, name) == 0)
            return view_at(i);
    return NULL;
}

size_t view_own_offset(int index)
{
    size_t offset = 0;
    for (int i = 0; i < index; i++)
        offset += (view_at(i)->def_size + 7) / 8 * 8;
    return offset;
}

void *view_own_settings(const ViewDef *def, const ViewKind *kind)
{
    for (int i = 0; view_at(i); i++)
        if (view_at(i) == kind)
            return (void *)(def->own.bytes + view_own_offset(i));
    return NULL;
}

void views_default(ViewDef *def)
{
    snprintf(def->kind, sizeof def->kind, "%s", view_at(0)->name);
    for (int i = 0; view_at(i); i++) {
        assert(view_own_offset(i + 1) <= VIEW_OWN_SIZE);
        if (view_at(i)->def)
            memcpy(def->own.bytes + view_own_offset(i), view_at(i)->def, view_at(i)->def_size);
    }
}

static void unknown_view(const char *name, Error *error)
{
    char known[256] = "";
    for (int i = 0; view_at(i); i++)
        snprintf(known + strlen(known), sizeof known - strlen(known), "%s%s", i ? ", " : "",
                 view_at(i)->name);
    error_set(error, "unknown view \"%s\"; known are: %s", name, known);
}

/* Particles are read from storage blocks: common/particles.glsl, listed.glsl and ball.glsl declare five. A
   ball is one vec4. */
static bool drawable(const ViewKind *kind, const Subject *subject, Error *error)
{
    const ViewDef *def = subject->def;
    const WorldDef *world = subject->world;
    const size_t particles = world->spacing > 0 ? flow_capacity(world, seed_count(world, world->spacing)) : 0;
    const ViewShapes *shapes = kind->shapes ? kind->shapes(def) : NULL;
    char who[NAME_SIZE + 32];
    snprintf(who, sizeof who, "view %s%s%s", def->kind, shapes ? " " : "", shapes ? shapes->words : "");
    const GlLimits have = gl_limits();
    const GlNeeds needs = {.who = who,
                           .instead = "use another GPU or driver",
                           .least = {.vertex_blocks = 5,
                                     .bindings = 11,
                                     .block_bytes = (int64_t)particles * (shapes ? shapes->bytes : 16)}};
    return gl_limits_allow(&have, &needs, error);
}

View *view_create(const Subject *subject, Error *error)
{
    const ViewDef *def = subject->def;
    const ViewKind *kind = view_find(def->kind);
    if (!kind) {
        unknown_view(def->kind, error);
        return NULL;
    }
    if (!drawable(kind, subject, error))
        return NULL;
    View *view = malloc(sizeof *view);
    void *state = view ? kind->create(subject, error) : NULL;
    if (!state) {
        free(view);
        return NULL;
    }
    *view = (View){kind, state};
    return view;
}

void view_destroy(View *view)
{
    if (!view)
        return;
    view->kind->destroy(view->state);
    free(view);
}

const ViewKind *view_kind(const View *view)
{
    return view->kind;
}

ParticleRadii view_ball_radii(const ViewDef *def, const ParticleBuffers *particles, double spacings)
{
    const float radius = (float)((def->radius > 0 ? def->radius : spacings) * particles->spacing);
    return (ParticleRadii){radius, radius, radius};
}

ParticleRadii view_radii(const ViewKind *kind, const ViewDef *def, const ParticleBuffers *particles)
{
    ParticleRadii radii = view_ball_radii(def, particles, kind ? kind->radius : 0);
    if (kind && kind->radii)
        kind->radii(def, particles, &radii);
    return radii;
}

void view_prepare(View *view, const ParticleBuffers *particles, const Frame *frame)
{
    if (view->kind->prepare)
        view->kind->prepare(view->state, particles, frame);
}

/* A view without a curve pays nothing for curves, and is made again when the def gets a curve. */
static bool same_curves(const ViewKind *kind, const ViewDef *a, const ViewDef *b)
{
    return !((kind->curves & VIEW_OPACITY) && (a->opacity.by != 0) != (b->opacity.by != 0)) &&
           !((kind->curves & VIEW_SIZE) && (a->size.by != 0) != (b->size.by != 0));
}

static size_t value_size(const Key *key)
{
    if (key->type == KEY_BOOLEAN)
        return sizeof(bool);
    assert(key->type == KEY_NUMBER || key->type == KEY_INTEGER || (key->flags & KEY_INDEX));
    return key->type == KEY_NUMBER ? sizeof(double) : sizeof(int);
}

/* True if all own keys with KEY_REBUILD are equal. */
static bool same_keys(const ViewKind *kind, const ViewDef *a, const ViewDef *b)
{
    const char *one = view_own_settings(a, kind), *other = view_own_settings(b, kind);
    for (const Key *key = kind->keys; key && key->path; key++)
        if ((key->flags & KEY_REBUILD) &&
            memcmp(one + key->offset, other + key->offset, value_size(key)) != 0)
            return false;
    return true;
}

bool view_is_compatible(const Subject *a, const Subject *b)
{
    const ViewKind *kind = view_find(a->def->kind);
    return strcmp(a->def->kind, b->def->kind) == 0 &&
           strcmp(view_colormap(a->def), view_colormap(b->def)) == 0 &&
           (a->world->solid_count > 0) == (b->world->solid_count > 0) &&
           (!kind || (same_curves(kind, a->def, b->def) && same_keys(kind, a->def, b->def) &&
                      (!kind->same || kind->same(a, b))));
}

const char *view_colormap(const ViewDef *def)
{
    return colormap_of(def->colormap, view_color_by(def));
}

bool view_shows_clear_fluid(const ViewDef *def)
{
    const ViewKind *kind = view_find(def->kind);
    return kind && kind->own_colors && kind->own_colors(def);
}

Scalar view_color_by(const ViewDef *def)
{
    if (def->color_by != SCALAR_COUNT)
        return def->color_by;
    return view_shows_clear_fluid(def) ? SCALAR_FLUID : SCALAR_SPEED;
}

bool view_has_foam(const ViewDef *def)
{
    return def->foam > 0 && view_shows_clear_fluid(def) && def->drawn_quality != VIEW_DRAFT;
}

bool view_has_glass(const ViewDef *def)
{
    return def->box &&
           (def->walls == VIEW_WALLS_GLASS || (def->walls == VIEW_WALLS_AUTO && view_shows_clear_fluid(def)));
}

ViewQuality view_quality(const ViewDef *def, bool moving)
{
    const ViewKind *kind = view_find(def->kind);
    const bool expensive = view_shows_clear_fluid(def) || (kind && kind->expensive && kind->expensive(def));
    if (def->quality != VIEW_AUTO)
        return (ViewQuality)def->quality;
    return moving && expensive && gl_renderer_is_software() ? VIEW_DRAFT : VIEW_GOOD;
}

ViewDef view_at_quality(const ViewDef *def, bool moving)
{
    ViewDef drawn = *def;
    const ViewKind *kind = view_find(def->kind);
    const ViewQuality quality = view_quality(def, moving);
    drawn.drawn_quality = quality;
    if (quality != VIEW_GOOD && kind && kind->quality)
        kind->quality(&drawn, quality);
    if (quality == VIEW_BEST && drawn.resolution == 1 && !(kind && kind->samples))
        drawn.resolution = FINEST_RESOLUTION;
    return drawn;
}

ViewDef view_in_file(const ViewDef *def)
{
    ViewDef drawn = *def;
    if (drawn.quality == VIEW_AUTO)
        drawn.quality = VIEW_BEST;
    return drawn;
}

bool view_accepts(View *view, const Subject *subject, Error *error)
{
    return !view->kind->accepts || view->kind->accepts(view->state, subject, error);
}

void view_want(const ViewDef *def, ParticleWants *wants)
{
    const ViewKind *kind = view_find(def->kind);
    if (kind && kind->want)
        kind->want(def, wants);
}

void view_show(const View *view, const ViewDef *def, Frame *frame)
{
    frame->curves.drawn = view->kind->curves;
    if (view->kind->show)
        view->kind->show(def, frame);
}

void view_cast(View *view, const ParticleBuffers *particles, const Frame *frame)
{
    if (view->kind->cast)
        view->kind->cast(view->state, particles, frame);
}

void view_draw(View *view, const ParticleBuffers *particles, const Frame *frame)
{
    view->kind->draw(view->state, particles, frame);
}

bool view_unfinished(const View *view)
{
    return view->kind->unfinished && view->kind->unfinished(view->state);
}

const char *view_note(View *view, bool *stale)
{
    return view->kind->note ? view->kind->note(view->state, stale) : NULL;
}

const char *view_missing(const View *view)
{
    return view->kind->missing ? view->kind->missing(view->state) : NULL;
}

bool view_pick(const View *view, const double pixel[2], double at[3])
{
    return view->kind->pick && view->kind->pick(view->state, pixel, at);
}

int view_probe(View *view, const double (*at)[3], int count, ViewProbe *out)
{
    return view->kind->probe ? view->kind->probe(view->state, at, count, out) : -1;
}

ViewProbing view_probing(const View *view, const ViewDef *def)
{
    static const ViewProbing nothing = {.by = VIEW_PROBE_NOTHING};
    return view->kind->probing ? view->kind->probing(view->state, def) : nothing;
}

static bool draw_wanted(const Picture *picture)
{
    return picture->view != NULL;
}

static void draw(void *state, Picture *picture)
{
    (void)state;
    view_draw(picture->view, picture->particles, &picture->frame);
}

const Effect effect_view = {
    .name = "view", .stage = STAGE_COUNT, .want = view_want, .wanted = draw_wanted, .draw = draw};

bool picture_has_front(const Picture *picture)
{
    return picture->view && picture->view->kind->draw_front;
}

static void draw_front(void *state, Picture *picture)
{
    (void)state;
    picture->view->kind->draw_front(picture->view->state, &picture->frame);
}

const Effect effect_view_front = {
    .name = "view_front", .stage = STAGE_COUNT, .wanted = picture_has_front, .draw = draw_front};
