#include "render/frame/view.h"

#include "render/frame/colormap.h"

#include "sim/gl/limits.h"
#include "sim/matter/flow.h"
#include "sim/matter/seed.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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

void *view_own(const ViewDef *def, const ViewKind *kind)
{
    for (int i = 0; view_at(i); i++)
        if (view_at(i) == kind)
            return (void *)def->of_view[i].bytes;
    return NULL;
}

void views_default(ViewDef *def)
{
    snprintf(def->kind, sizeof def->kind, "%s", view_at(0)->name);
    for (int i = 0; view_at(i); i++) {
        assert(view_at(i)->def_size <= VIEW_OWN_SIZE);
        if (view_at(i)->def)
            memcpy(def->of_view[i].bytes, view_at(i)->def, view_at(i)->def_size);
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

ParticleRadii view_radii(const ViewKind *kind, const ViewDef *def, const ParticleBuffers *particles)
{
    ParticleRadii radii = frame_balls(def, particles, kind ? kind->radius : 0);
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
    const char *one = view_own(a, kind), *other = view_own(b, kind);
    for (const Key *key = kind->keys; key && key->path; key++)
        if ((key->flags & KEY_REBUILD) &&
            memcmp(one + key->offset, other + key->offset, value_size(key)) != 0)
            return false;
    return true;
}

bool view_same(const Subject *a, const Subject *b)
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
    const bool dear = view_shows_clear_fluid(def) || (kind && kind->dear && kind->dear(def));
    if (def->quality != VIEW_AUTO)
        return (ViewQuality)def->quality;
    return moving && dear && gl_renderer_is_software() ? VIEW_DRAFT : VIEW_GOOD;
}

ViewDef view_at_quality(const ViewDef *def, bool moving)
{
    ViewDef drawn = *def;
    const ViewKind *kind = view_find(def->kind);
    const ViewQuality quality = view_quality(def, moving);
    drawn.drawn_quality = quality;
    if (quality != VIEW_GOOD && kind && kind->quality)
        kind->quality(&drawn, quality);
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
    frame->curves = view->kind->curves;
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

void view_draw_front(View *view, const Frame *frame)
{
    if (view->kind->draw_front)
        view->kind->draw_front(view->state, frame);
}

bool view_unfinished(const View *view)
{
    return view->kind->unfinished && view->kind->unfinished(view->state);
}

const char *view_note(View *view, bool *behind)
{
    return view->kind->note ? view->kind->note(view->state, behind) : NULL;
}

const char *view_lacks(const View *view)
{
    return view->kind->lacks ? view->kind->lacks(view->state) : NULL;
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
