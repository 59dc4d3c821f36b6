#include "render/renderer.h"

#include "render/derived/derived.h"
#include "render/derived/ranges.h"
#include "render/frame/backdrop.h"
#include "render/frame/edges.h"
#include "render/frame/legend.h"
#include "render/frame/overlay.h"
#include "render/frame/shadow.h"
#include "render/frame/solids.h"
#include "render/frame/view.h"
#include "sim/gl/timer.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

static const WorldDef unknown;

struct Renderer {
    ViewDef def;
    WorldDef world;
    bool plain;
    Covered covered;
    Title title;
    double range[2], opacity_range[2], size_range[2]; /* of the last picture */
    Target target;
    unsigned uniforms;
    Derived derived;
    Ranges ranges; /* nothing before the first picture that asks for one */
    Shadow shadow;
    Backdrop backdrop;
    Edges edges;
    Text *text;     /* NULL before the first legend */
    Solids *solids; /* NULL without */
    View *view;     /* NULL for "none" */
    Overlays overlays;
};

ViewDef view_def_default(void)
{
    ViewDef def = view_def_shared();
    views_default(&def);
    overlays_default(&def);
    return def;
}

static Subject subject_of(const Renderer *renderer)
{
    return (Subject){&renderer->def, &renderer->world};
}

/* Letters for a picture that high, or none where neither legend nor title wants some. */
static bool follow_letters(Renderer *renderer, bool wanted, int height, Error *error)
{
    const float pixels = legend_text_pixels(height);
    if (!wanted || (renderer->text && text_height(renderer->text) == pixels))
        return true;
    Text *text = text_create(pixels, error);
    if (!text)
        return false;
    text_destroy(renderer->text);
    renderer->text = text;
    return true;
}

/* Made with the first solid. On failure all stays as it was. */
static bool follow_solids(Renderer *renderer, const WorldDef *world, Error *error)
{
    if (world->solid_count == 0 || renderer->solids)
        return true;
    renderer->solids = solids_create(error);
    if (renderer->solids && shadow_follow_solids(&renderer->shadow, true, error))
        return true;
    solids_destroy(renderer->solids);
    renderer->solids = NULL;
    return false;
}

static void drop_unused_solids(Renderer *renderer)
{
    Error none;
    if (renderer->world.solid_count > 0)
        return;
    solids_destroy(renderer->solids);
    renderer->solids = NULL;
    shadow_follow_solids(&renderer->shadow, false, &none);
}

/* The fluid is a number here, not what has a colour. */
static void want_curve(ParticleWants *wants, const ScalarCurve *curve)
{
    if (curve->by == 0)
        return;
    const int scalar = scalar_of_curve(curve);
    if (scalar < SCALAR_STATE_COUNT)
        wants->attributes |= PARTICLE_SCALAR(scalar);
    else
        wants->scalars |= SCALAR_BIT(scalar);
}

/* What a picture by that def reads of the particles: who draws adds here what it reads. Screen-doors go by
   ids. */
static ParticleWants wants_of(const ViewDef *def)
{
    ParticleWants wants = {.scalars = SCALAR_BIT(def->color_by)};
    overlays_want(def, &wants);
    want_curve(&wants, &def->opacity);
    want_curve(&wants, &def->size);
    if (def->opacity.by != 0)
        wants.attributes |= PARTICLE_SCALAR(SCALAR_ID);
    return wants;
}

unsigned renderer_attributes(const ViewDef *def)
{
    const unsigned fluid =
        PARTICLE_SCALAR(SCALAR_FLUID); /* as a number; as a colour it is among the scalars */
    ParticleWants all = {UINT32_MAX, UINT32_MAX, fluid};
    overlays_want(NULL, &all);
    const ParticleWants wants = def ? wants_of(def) : all;
    return wants_attributes(&wants);
}

static bool follow_derived(Renderer *renderer, const ViewDef *def, Error *error)
{
    const ParticleWants wants = wants_of(def);
    if (!derived_follow(&renderer->derived, &wants, error))
        return false;
    if (!view_def_ranges(def) || renderer->ranges.find)
        return true;
    if (ranges_create(&renderer->ranges, error))
        return true;
    ranges_destroy(&renderer->ranges);
    return false;
}

static bool create_parts(Renderer *renderer, int width, int height, Error *error)
{
    const ViewDef *def = &renderer->def;
    const Subject subject = subject_of(renderer);
    if (!target_create(&renderer->target, width, height, error) || !shadow_create(&renderer->shadow, error) ||
        !backdrop_create(&renderer->backdrop, error) || !edges_create(&renderer->edges, error))
        return false;
    renderer->uniforms = frame_uniforms_create();
    return follow_derived(renderer, def, error) && follow_letters(renderer, def->legend, height, error) &&
           follow_solids(renderer, &renderer->world, error) &&
           (strcmp(def->kind, "none") == 0 || (renderer->view = view_create(&subject, error)) != NULL) &&
           overlays_follow(&renderer->overlays, &subject, error);
}

/* A software driver takes half a kilobyte a particle for each picture and frees it: blocks of 64 KB, which
   glibc would hand back to the system and fault in anew, page by page, a quarter of a picture's time. glibc
   knows such a setting for the whole process only: hence here, where pictures begin, and not where there are
   none. */
static void keep_freed_memory(void)
{
#ifdef __GLIBC__
    if (!gl_renderer_is_software())
        return;
    mallopt(M_TRIM_THRESHOLD, 256 << 20);
    mallopt(M_MMAP_THRESHOLD, 32 << 20); /* as glibc lets it grow by itself, until one of the two is set */
#endif
}

Renderer *renderer_create(const ViewDef *def, const WorldDef *world, int width, int height, Error *error)
{
    Renderer *renderer = calloc(1, sizeof *renderer);
    if (!renderer) {
        error_set(error, "out of memory for the renderer");
        return NULL;
    }
    renderer->def = *def;
    renderer->world = *(world ? world : &unknown);
    keep_freed_memory();
    if (create_parts(renderer, width, height, error))
        return renderer;
    renderer_destroy(renderer);
    return NULL;
}

void renderer_destroy(Renderer *renderer)
{
    if (!renderer)
        return;
    overlays_destroy(&renderer->overlays);
    view_destroy(renderer->view);
    text_destroy(renderer->text);
    edges_destroy(&renderer->edges);
    solids_destroy(renderer->solids);
    backdrop_destroy(&renderer->backdrop);
    shadow_destroy(&renderer->shadow);
    ranges_destroy(&renderer->ranges);
    derived_destroy(&renderer->derived);
    glDeleteBuffers(1, &renderer->uniforms);
    target_destroy(&renderer->target);
    free(renderer);
}

/* `view`: for that subject, the renderer's own or a new one. */
static bool make_view(const Renderer *renderer, const Subject *subject, View **view, Error *error)
{
    const Subject old = subject_of(renderer);
    const bool none = strcmp(subject->def->kind, "none") == 0;
    *view = renderer->view;
    if (view_same(&old, subject))
        return !*view || view_accepts(*view, subject, error);
    *view = none ? NULL : view_create(subject, error);
    return *view || none;
}

/* View and overlays, or neither: what an overlay has gathered would be lost with it. */
static bool follow_view(Renderer *renderer, const Subject *subject, Error *error)
{
    View *view;
    const bool followed =
        make_view(renderer, subject, &view, error) && overlays_follow(&renderer->overlays, subject, error);
    View *gone = followed ? renderer->view : view;
    if (view != renderer->view)
        view_destroy(gone);
    if (followed)
        renderer->view = view;
    return followed;
}

bool renderer_set_def(Renderer *renderer, const ViewDef *def, const WorldDef *world, Error *error)
{
    const Subject subject = {def, world ? world : &unknown};
    const bool letters = def->legend || *renderer->title.words;
    const bool followed = follow_derived(renderer, def, error) &&
                          follow_letters(renderer, letters, renderer->target.height, error) &&
                          follow_solids(renderer, subject.world, error) &&
                          follow_view(renderer, &subject, error);
    if (followed) {
        renderer->def = *def;
        renderer->world = *subject.world;
    }
    drop_unused_solids(renderer);
    return followed;
}

bool renderer_resize(Renderer *renderer, int width, int height, Error *error)
{
    Target target;
    if (width == renderer->target.width && height == renderer->target.height)
        return true;
    if (!target_create(&target, width, height, error))
        return false;
    if (!follow_letters(renderer, renderer->def.legend || *renderer->title.words, height, error)) {
        target_destroy(&target);
        return false;
    }
    target_destroy(&renderer->target);
    renderer->target = target;
    return true;
}

static void draw_shadow(Renderer *renderer, const ParticleBuffers *particles, const Frame *frame)
{
    if (renderer->solids) {
        solids_place(renderer->solids, particles, frame);
        shadow_begin_solids(&renderer->shadow);
        solids_cast(renderer->solids);
    }
    shadow_begin(&renderer->shadow);
    if (renderer->view)
        view_cast(renderer->view, particles, frame);
    shadow_end(&renderer->shadow, frame);
}

static void draw_edges_and_text(Renderer *renderer, const ParticleBuffers *particles, const Frame *frame)
{
    glBindFramebuffer(GL_FRAMEBUFFER, renderer->target.framebuffer); /* an empty view may not have done so */
    if (renderer->def.box && !frame->flat)
        edges_draw(&renderer->edges, frame);
    if (!renderer->def.legend && !*renderer->title.words)
        return;
    text_begin(renderer->text, frame->width, frame->height);
    if (renderer->def.legend) {
        legend_draw(renderer->text, frame, particles->time);
        overlays_legend(&renderer->overlays, renderer->text, frame);
    }
    title_draw(renderer->text, &renderer->title, frame);
    text_end(renderer->text);
}

/* Whether a picture by that def needs more than the state has. */
static bool derives(const ViewDef *def)
{
    const ParticleWants wants = wants_of(def);
    return view_def_ranges(def) || wants.vectors || wants.scalars >> SCALAR_STATE_COUNT;
}

static void derive(Renderer *renderer, const ParticleWants *wants, ParticleBuffers *particles)
{
    DerivedSpace space = {.flat = frame_slab(particles) > 0};
    memcpy(space.periodic, renderer->world.periodic, sizeof space.periodic);
    derived_fill(&renderer->derived, wants, &space, particles);
}

void renderer_derive(Renderer *renderer, ParticleBuffers *particles)
{
    const ParticleWants wants = wants_of(&renderer->def);
    const uint32_t ranged = view_def_ranges(&renderer->def);
    derive(renderer, &wants, particles);
    for (int s = 0; s < SCALAR_COUNT; s++)
        if ((ranged & SCALAR_BIT(s)) && !particles->range[s].known)
            particles->range[s] = ranges_find(&renderer->ranges, &particles->scalar[s], particles->count);
}

/* The state as passes read it. */
static ParticleBuffers derived_of(Renderer *renderer, const ParticleBuffers *state, GlTimer *timer)
{
    ParticleBuffers with = *state;
    if (derives(&renderer->def))
        GL_STAGE(timer, STAGE_SCALARS)
        {
            renderer_derive(renderer, &with);
        }
    return with;
}

static void draw(Renderer *renderer, const ParticleBuffers *state, GlTimer *timer, ViewCounts *counts)
{
    Frame frame;
    const ParticleBuffers with = derived_of(renderer, state, timer), *particles = &with;
    const ViewKind *kind = renderer->view ? view_kind(renderer->view) : NULL;
    const Target *target = &renderer->target;
    const Subject subject = subject_of(renderer);
    const double legend =
        legend_width_pixels(&renderer->def, &renderer->world, target->height) / target->width;
    frame_make(&frame, &subject, particles, target, view_radii(kind, &renderer->def, particles),
               (Covered){renderer->covered.left, fmax(renderer->covered.right, legend)});
    frame.timer = timer;
    frame.counts = counts;
    frame.plain = renderer->plain;
    frame.floor_light = renderer->shadow.floor_map;
    if (renderer->view)
        view_show(renderer->view, &renderer->def, &frame);
    memcpy(renderer->range, frame.range, sizeof renderer->range);
    memcpy(renderer->opacity_range, frame.opacity_range, sizeof renderer->opacity_range);
    memcpy(renderer->size_range, frame.size_range, sizeof renderer->size_range);
    frame_uniforms_update(renderer->uniforms, &frame, particles->box_size, particles->spacing);
    overlays_take(&renderer->overlays, particles, &subject, timer);
    if (renderer->view)
        view_prepare(renderer->view, particles, &frame);
    GL_STAGE(timer, STAGE_SHADOW)
    draw_shadow(renderer, particles, &frame);
    GL_STAGE(timer, STAGE_BACKDROP)
    {
        target_begin(&renderer->target);
        backdrop_draw(&renderer->backdrop, &frame, &renderer->shadow);
    }
    if (renderer->solids)
        GL_STAGE(timer, STAGE_SOLIDS)
        {
            solids_draw(renderer->solids, &frame);
        }
    if (renderer->view) {
        view_draw(renderer->view, particles, &frame);
        if (renderer->def.legend) /* which waits for what it tells */
            frame.note = view_note(renderer->view);
    }
    if (!frame.flat)
        overlays_draw(&renderer->overlays, particles, &frame);
    GL_STAGE(timer, STAGE_OVERLAY)
    draw_edges_and_text(renderer, particles, &frame);
}

void renderer_take(Renderer *renderer, const ParticleBuffers *state, GlTimer *timer)
{
    const Subject subject = subject_of(renderer);
    const ParticleWants wants = {.scalars = SCALAR_BIT(renderer->def.color_by)}; /* all that is kept of one */
    ParticleBuffers with = *state;
    if (!overlays_take_any(&renderer->overlays))
        return;
    if ((int)renderer->def.color_by >= SCALAR_STATE_COUNT)
        GL_STAGE(timer, STAGE_SCALARS)
        {
            derive(renderer, &wants, &with);
        }
    overlays_take(&renderer->overlays, &with, &subject, timer);
}

void renderer_draw(Renderer *renderer, const ParticleBuffers *particles, GlTimer *timer)
{
    draw(renderer, particles, timer, NULL);
}

void renderer_count(Renderer *renderer, const ParticleBuffers *particles, ViewCounts *counts)
{
    *counts = (ViewCounts){0};
    draw(renderer, particles, NULL, counts);
}

void renderer_read(const Renderer *renderer, uint8_t *rgb)
{
    target_read(&renderer->target, rgb);
}

void renderer_present(const Renderer *renderer, int x, int y)
{
    target_present(&renderer->target, x, y);
}

void renderer_read_depth(const Renderer *renderer, float *depth)
{
    target_read_depth(&renderer->target, depth);
}

void renderer_set_covered(Renderer *renderer, Covered covered)
{
    renderer->covered = covered;
}

bool renderer_set_title(Renderer *renderer, const Title *title, Error *error)
{
    if (!follow_letters(renderer, renderer->def.legend || *title->words, renderer->target.height, error))
        return false;
    renderer->title = *title;
    return true;
}

void renderer_range(const Renderer *renderer, double range[2])
{
    memcpy(range, renderer->range, sizeof renderer->range);
}

void renderer_curve_ranges(const Renderer *renderer, double opacity[2], double size[2])
{
    memcpy(opacity, renderer->opacity_range, sizeof renderer->opacity_range);
    memcpy(size, renderer->size_range, sizeof renderer->size_range);
}

void renderer_set_plain(Renderer *renderer, bool plain)
{
    renderer->plain = plain;
}

bool renderer_pick(const Renderer *renderer, const double pixel[2], double at[3])
{
    return renderer->view && view_pick(renderer->view, pixel, at);
}

int renderer_probe(Renderer *renderer, const double (*at)[3], int count, ViewProbe *out)
{
    return renderer->view ? view_probe(renderer->view, at, count, out) : -1;
}
