#include "render/renderer.h"

#include "render/frame/passes.h"
#include "render/frame/view.h"
#include "render/particles/derived.h"
#include "render/picking/picking.h"
#include "render/water/water.h"
#include "sim/gpu/timer.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

static const WorldDef unknown;

/* Inputs of the last picture that drawing over the picture needs. */
typedef struct DrawnPicture {
    Frame frame;
    double time, box_size[3], spacing;
    bool whole; /* the renderer's target holds the whole picture */
} DrawnPicture;

struct Renderer {
    ViewDef said; /* as given by the caller */
    ViewDef def;  /* at the chosen quality */
    WorldDef world;
    bool plain, more;
    bool late;         /* ranges and legend text of a picture may be of the previous picture: */
    bool stale;        /* true in this picture, */
    bool showed_stale; /* true in the last picture */
    bool flat;         /* Frame.flat of the last picture */
    CoveredParts covered;
    Title title;
    char note[96];
    double range[2], opacity_range[2], size_range[2]; /* ranges of the last picture */
    Target target;
    Upscale upscale;
    DrawnPicture drawn;
    bool presents;     /* a coarse picture is enlarged when presented */
    OverlayDepth over; /* empty before the first picture of a view with draw_front */
    unsigned uniforms;
    Derived derived;
    Ranges ranges; /* empty before the first picture with an automatic range */
    Shadow shadow;
    Backdrop backdrop;
    BoxEdges edges;
    Glass glass;       /* empty before the first def with glass */
    Caustics caustics; /* likewise */
    Foam foam;         /* likewise */
    Text *text;        /* NULL before the first legend */
    Solids *solids;    /* NULL without solids */
    View *view;        /* NULL for "none" */
    Overlays overlays;
    PictureProbe probe; /* answers about the last picture */
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

static bool is_coarse(const Renderer *renderer)
{
    return renderer->upscale.target.framebuffer != 0;
}

/* The target of drawing. */
static const Target *drawn_target(const Renderer *renderer)
{
    return is_coarse(renderer) ? &renderer->upscale.target : &renderer->target;
}

static bool has_letters(const ViewDef *def, const Title *title)
{
    return def->legend || *title->words || *def->title;
}

/* Makes letters for a picture of `height`, unless neither legend nor title needs letters. */
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

/* Creates the solids with the first solid of the world. Returns false on failure and changes nothing. */
static bool follow_solids(Renderer *renderer, const WorldDef *world, Error *error)
{
    if (world->solid_count == 0 || renderer->solids)
        return true;
    renderer->solids = solids_create(error);
    if (renderer->solids && shadow_update_solids(&renderer->shadow, true, error))
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
    shadow_update_solids(&renderer->shadow, false, &none);
}

/* Here the fluid counts as a number, not as a colour. */
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

/* The particle data that a picture by `def` reads: each part that draws adds its wishes here. Screen-doors
   need ids. */
static ParticleWants wants_of(const ViewDef *def)
{
    ParticleWants wants = {.scalars = SCALAR_BIT(view_color_by(def))};
    overlays_want(def, &wants);
    view_want(def, &wants);
    if (view_has_foam(def))
        foam_want(&wants);
    want_curve(&wants, &def->opacity);
    want_curve(&wants, &def->size);
    if (def->opacity.by != 0)
        wants.attributes |= PARTICLE_SCALAR(SCALAR_ID);
    return wants;
}

/* Adds the data computed for foam, which does not become part of the state: derived_trapped_air. */
static ParticleWants made_for(const ViewDef *def)
{
    ParticleWants wants = wants_of(def);
    if (view_has_foam(def))
        wants.scalars |= SCALAR_BIT(SCALAR_TRAPPED_AIR);
    return wants;
}

unsigned renderer_attributes(const ViewDef *def)
{
    const unsigned fluid =
        PARTICLE_SCALAR(SCALAR_FLUID); /* as a number; as a colour, the fluid is among the scalars */
    ParticleWants all = {UINT64_MAX, UINT32_MAX, fluid};
    overlays_want(NULL, &all);
    const ParticleWants wants = def ? wants_of(def) : all;
    return particle_wants_attributes(&wants);
}

static bool follow_derived(Renderer *renderer, const ViewDef *def, Error *error)
{
    const ParticleWants wants = made_for(def);
    if (!derived_update(&renderer->derived, &wants, error))
        return false;
    if (!view_def_ranges(def) || renderer->ranges.find)
        return true;
    if (ranges_create(&renderer->ranges, error))
        return true;
    ranges_destroy(&renderer->ranges);
    return false;
}

/* Creates the extras of clear fluid. Panes are created for a draft too, since a draft may end at any time. */
static bool follow_clear(Renderer *renderer, const ViewDef *def, Error *error)
{
    const bool caustics =
        def->caustics && view_shows_clear_fluid(def) && def->drawn_quality != VIEW_DRAFT && def->floor;
    return (!view_has_glass(def) || glass_create(&renderer->glass, error)) &&
           (!caustics || caustics_create(&renderer->caustics, error)) &&
           (!view_has_foam(def) || foam_create(&renderer->foam, error));
}

static bool create_parts(Renderer *renderer, int width, int height, Error *error)
{
    const ViewDef *def = &renderer->def;
    const Subject subject = subject_of(renderer);
    if (!target_create(&renderer->target, width, height, error) ||
        !upscale_update(&renderer->upscale, def->resolution, width, height, error) ||
        !shadow_create(&renderer->shadow, error) || !backdrop_create(&renderer->backdrop, error) ||
        !box_edges_create(&renderer->edges, error))
        return false;
    renderer->uniforms = frame_uniforms_create();
    return follow_derived(renderer, def, error) &&
           follow_letters(renderer, has_letters(def, &renderer->title), height, error) &&
           follow_clear(renderer, def, error) && follow_solids(renderer, &renderer->world, error) &&
           (strcmp(def->kind, "none") == 0 || (renderer->view = view_create(&subject, error)) != NULL) &&
           overlays_update(&renderer->overlays, &subject, error);
}

/* A software driver allocates half a kilobyte per particle for each picture, in blocks of 64 KB, and frees
   the blocks again. glibc would return the memory to the system and fault in each page again: a quarter of
   a picture's time. glibc has this setting for the whole process only: hence set here, where pictures
   start. */
static void keep_freed_memory(void)
{
#ifdef __GLIBC__
    if (!gl_renderer_is_software())
        return;
    mallopt(M_TRIM_THRESHOLD, 256 << 20);
    mallopt(M_MMAP_THRESHOLD, 32 << 20); /* glibc raises this threshold by itself until either of the two
                                            is set */
#endif
}

Renderer *renderer_create(const ViewDef *def, const WorldDef *world, int width, int height, Error *error)
{
    Renderer *renderer = calloc(1, sizeof *renderer);
    if (!renderer) {
        error_set(error, "out of memory for the renderer");
        return NULL;
    }
    renderer->said = *def;
    renderer->def = view_at_quality(def, false);
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
    picture_probe_destroy(&renderer->probe);
    overlays_destroy(&renderer->overlays);
    view_destroy(renderer->view);
    text_destroy(renderer->text);
    box_edges_destroy(&renderer->edges);
    glass_destroy(&renderer->glass);
    caustics_destroy(&renderer->caustics);
    foam_destroy(&renderer->foam);
    solids_destroy(renderer->solids);
    backdrop_destroy(&renderer->backdrop);
    shadow_destroy(&renderer->shadow);
    ranges_destroy(&renderer->ranges);
    derived_destroy(&renderer->derived);
    glDeleteBuffers(1, &renderer->uniforms);
    overlay_depth_destroy(&renderer->over);
    target_destroy(&renderer->target);
    upscale_destroy(&renderer->upscale);
    free(renderer);
}

/* `view`: a view for the subject, the renderer's own or a new view. */
static bool make_view(const Renderer *renderer, const Subject *subject, View **view, Error *error)
{
    const Subject old = subject_of(renderer);
    const bool none = strcmp(subject->def->kind, "none") == 0;
    *view = renderer->view;
    if (view_is_compatible(&old, subject))
        return !*view || view_accepts(*view, subject, error);
    *view = none ? NULL : view_create(subject, error);
    return *view || none;
}

/* Changes view and overlays, or neither: a destroyed overlay would lose its gathered data. */
static bool follow_view(Renderer *renderer, const Subject *subject, Error *error)
{
    View *view;
    const bool followed =
        make_view(renderer, subject, &view, error) && overlays_update(&renderer->overlays, subject, error);
    View *gone = followed ? renderer->view : view;
    if (view != renderer->view)
        view_destroy(gone);
    if (followed)
        renderer->view = view;
    return followed;
}

bool renderer_set_def(Renderer *renderer, const ViewDef *said, const WorldDef *world, Error *error)
{
    const ViewDef drawn = view_at_quality(said, renderer->more), *def = &drawn;
    const Subject subject = {def, world ? world : &unknown};
    const bool letters = has_letters(def, &renderer->title);
    const bool followed = follow_derived(renderer, def, error) && follow_clear(renderer, def, error) &&
                          follow_letters(renderer, letters, renderer->target.height, error) &&
                          follow_solids(renderer, subject.world, error) &&
                          upscale_update(&renderer->upscale, def->resolution, renderer->target.width,
                                         renderer->target.height, error) &&
                          follow_view(renderer, &subject, error);
    if (followed) {
        const ParticleWants wants = made_for(def);
        renderer->said = *said;
        renderer->def = *def;
        renderer->world = *subject.world;
        derived_release(&renderer->derived, &wants);
    }
    drop_unused_solids(renderer);
    picture_probe_clear(&renderer->probe);
    return followed;
}

bool renderer_resize(Renderer *renderer, int width, int height, Error *error)
{
    Target target;
    if (width == renderer->target.width && height == renderer->target.height)
        return true;
    if (!target_create(&target, width, height, error))
        return false;
    if (!follow_letters(renderer, has_letters(&renderer->def, &renderer->title), height, error) ||
        !upscale_update(&renderer->upscale, renderer->def.resolution, width, height, error)) {
        target_destroy(&target);
        return false;
    }
    target_destroy(&renderer->target);
    renderer->target = target;
    picture_probe_clear(&renderer->probe);
    return true;
}

static void draw_shadow(Renderer *renderer, const ParticleBuffers *particles, const Frame *frame)
{
    if (renderer->solids) {
        solids_update_poses(renderer->solids, particles, frame);
        shadow_begin_solids(&renderer->shadow);
        solids_cast(renderer->solids);
    }
    shadow_begin(&renderer->shadow);
    if (renderer->view)
        view_cast(renderer->view, particles, frame);
    shadow_end(&renderer->shadow, frame);
}

/* True if the view draws parts in front of overlays and edges. */
static bool draws_front(const Renderer *renderer)
{
    return renderer->view && view_kind(renderer->view)->draw_front;
}

static bool has_edges(const Renderer *renderer, const Frame *frame)
{
    return renderer->def.box && !frame->flat;
}

/* True in a two-dimensional scene: overlays lie over everything. */
static bool is_over_all(const Frame *frame)
{
    return frame->slab > 0;
}

/* Sets the frame's overlay_depth, overlay_depth_missing and overlay_depth_coarse. */
static void draw_over_depth(Renderer *renderer, const ParticleBuffers *particles, Frame *frame)
{
    const bool overlays = !is_over_all(frame) && overlays_any(&renderer->overlays);
    Frame depths = *frame;
    if (!draws_front(renderer) || (!overlays && !has_edges(renderer, frame)))
        return;
    Target target;
    frame->overlay_depth_missing = !overlay_depth_begin(&renderer->over, frame->target, &target);
    if (frame->overlay_depth_missing)
        return;
    depths.target = &target;
    depths.depths = true;
    if (overlays)
        overlays_draw(&renderer->overlays, particles, &depths);
    if (has_edges(renderer, frame))
        GL_STAGE(frame->timer, STAGE_OVERLAY)
        {
            box_edges_draw(&renderer->edges, &depths);
        }
    frame->overlay_depth = target.depth;
    frame->overlay_depth_coarse = overlays && overlays_unfinished(&renderer->overlays);
}

/* Called after the view: draws overlays and edges over the view, then the view's front parts over these. */
static void draw_overlays(Renderer *renderer, const ParticleBuffers *particles, const Frame *frame)
{
    if (!frame->flat && !is_over_all(frame))
        overlays_draw(&renderer->overlays, particles, frame);
    if (draws_front(renderer)) {
        if (has_edges(renderer, frame))
            GL_STAGE(frame->timer, STAGE_OVERLAY)
            {
                box_edges_draw(&renderer->edges, frame);
            }
        view_draw_front(renderer->view, frame);
    }
    if (!frame->flat && is_over_all(frame))
        overlays_draw(&renderer->overlays, particles, frame);
}

/* Draws into the bound framebuffer. */
static void draw_words(Renderer *renderer, const Frame *frame, double time)
{
    if (!has_letters(&renderer->def, &renderer->title))
        return;
    text_begin(renderer->text, frame->width, frame->height);
    if (renderer->def.legend) {
        legend_draw(renderer->text, frame, time);
        overlays_legend(&renderer->overlays, renderer->text, frame);
    }
    title_draw(renderer->text, &renderer->title, frame);
    caption_draw(renderer->text, frame);
    text_end(renderer->text);
}

/* Enlarges the last coarse picture and adds the parts with full resolution. */
static void make_whole(Renderer *renderer, GLuint framebuffer)
{
    const DrawnPicture *drawn = &renderer->drawn;
    const Upscale *upscale = &renderer->upscale;
    Frame shown = drawn->frame;
    shown.width = renderer->target.width;
    shown.height = renderer->target.height;
    upscale_draw(upscale, framebuffer, shown.width, shown.height);
    frame_uniforms_update(renderer->uniforms, &shown, drawn->box_size, drawn->spacing);
    if (has_edges(renderer, &shown) && !draws_front(renderer))
        box_edges_draw_upscaled(&renderer->edges, upscale->edges, &shown, upscale->target.depth);
    draw_words(renderer, &shown, drawn->time);
    frame_uniforms_update(renderer->uniforms, &drawn->frame, drawn->box_size,
                          drawn->spacing); /* for probes */
    glEnable(GL_FRAMEBUFFER_SRGB);
}

/* Draws the parts over the whole picture. */
static void draw_over(Renderer *renderer, const ParticleBuffers *particles, const Frame *frame)
{
    DrawnPicture *drawn = &renderer->drawn;
    *drawn = (DrawnPicture){.frame = *frame, .time = particles->time, .spacing = particles->spacing};
    memcpy(drawn->box_size, particles->box_size, sizeof drawn->box_size);
    drawn->whole = !is_coarse(renderer) || !renderer->presents;
    if (is_coarse(renderer)) {
        if (drawn->whole)
            make_whole(renderer, renderer->target.framebuffer);
        return;
    }
    glBindFramebuffer(GL_FRAMEBUFFER, renderer->target.framebuffer); /* an empty view may have bound no
                                                                        framebuffer */
    if (has_edges(renderer, frame) && !draws_front(renderer))
        box_edges_draw(&renderer->edges, frame);
    draw_words(renderer, frame, particles->time);
}

/* True if a picture by `def` needs derived data. */
static bool derives(const ViewDef *def)
{
    const ParticleWants wants = wants_of(def);
    return view_def_ranges(def) || wants.vectors || wants.scalars >> SCALAR_STATE_COUNT ||
           particle_wants_attributes(&wants) & PARTICLE_SCALAR(SCALAR_BORN);
}

static DerivedSpace space_of(const Renderer *renderer, const ParticleBuffers *particles)
{
    DerivedSpace space = {.flat = frame_slab_depth(particles) > 0};
    memcpy(space.periodic, renderer->world.periodic, sizeof space.periodic);
    return space;
}

static void derive(Renderer *renderer, const ParticleWants *wants, ParticleBuffers *particles)
{
    const DerivedSpace space = space_of(renderer, particles);
    derived_fill(&renderer->derived, wants, &space, particles);
}

static ScalarRange range_of(Renderer *renderer, Scalar scalar, const ParticleBuffers *particles)
{
    return renderer->late ? ranges_find_async(&renderer->ranges, scalar, particles, &renderer->stale)
                          : ranges_find(&renderer->ranges, &particles->scalar[scalar], particles->count);
}

void renderer_derive(Renderer *renderer, ParticleBuffers *particles)
{
    const ParticleWants wants = wants_of(&renderer->def);
    const uint64_t ranged = view_def_ranges(&renderer->def);
    derive(renderer, &wants, particles);
    for (int s = 0; s < SCALAR_COUNT; s++)
        if ((ranged & SCALAR_BIT(s)) && !particles->range[s].known)
            particles->range[s] = range_of(renderer, (Scalar)s, particles);
}

/* The state with derived data, for the passes. */
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

/* Note about values that the colours cannot show; NULL: no note. */
static const char *note_of(Renderer *renderer, const ParticleBuffers *particles)
{
    const ScalarRange *range = &particles->range[view_color_by(&renderer->def)];
    const char *name = scalar_name(view_color_by(&renderer->def));
    const bool waits = strncmp(name, "acceleration", strlen("acceleration")) == 0;
    if (renderer->derived.lacks)
        snprintf(renderer->note, sizeof renderer->note, "the GPU has no memory for %s",
                 renderer->derived.lacks);
    else if (particles->count > 0 && range->known && !range->any)
        return waits ? "no particle has a number before a step" : "no particle has a number";
    else
        return NULL;
    return renderer->note;
}

/* Frame.glass. With `auto`, a picture without a clear fluid surface (an intermediate stage of the view)
   has lines. */
static int glass_of(const Renderer *renderer, const Frame *frame)
{
    const ViewDef *def = &renderer->def;
    const bool glass = view_has_glass(def) && !frame->flat && !(frame->slab > 0) &&
                       (def->walls == VIEW_WALLS_GLASS || frame->clear > 0);
    return !glass ? 0 : def->drawn_quality == VIEW_DRAFT ? 1 : 2;
}

static void draw_caustics(const Renderer *renderer, const ParticleBuffers *particles, Frame *frame)
{
    if (particles->count > 0 && caustics_wanted(frame))
        frame->floor_light = caustics_draw(&renderer->caustics, particles, frame, renderer->shadow.floor_map);
}

static void draw_panes(const Renderer *renderer, const Frame *frame, bool behind)
{
    if (frame->glass == 2)
        GL_STAGE(frame->timer, STAGE_OVERLAY)
        {
            glass_draw(&renderer->glass, frame, behind);
        }
}

/* A picture without a clear fluid surface (an intermediate stage of the view) has no foam. */
static bool has_foam(const Renderer *renderer, const Frame *frame)
{
    return view_has_foam(&renderer->def) && frame->clear > 0 && !(frame->slab > 0);
}

static void draw_foam(Renderer *renderer, const ParticleBuffers *particles, const Frame *frame)
{
    const DerivedSpace space = space_of(renderer, particles);
    ParticleAttribute air = {0};
    GL_STAGE(frame->timer, STAGE_SCALARS)
    {
        air = derived_trapped_air(&renderer->derived, &space, particles, foam_slowest(&renderer->def));
    }
    GL_STAGE(frame->timer, STAGE_FOAM)
    {
        foam_draw(&renderer->foam, particles, &air, frame);
    }
}

static void draw_view(Renderer *renderer, const ParticleBuffers *particles, Frame *frame)
{
    const bool foam = has_foam(renderer, frame);
    if (foam)
        GL_STAGE(frame->timer, STAGE_FOAM)
        {
            foam_begin(&renderer->foam, frame);
        }
    view_draw(renderer->view, particles, frame);
    if (foam)
        draw_foam(renderer, particles, frame);
    if (renderer->def.legend) /* may wait for the GPU */
        frame->note = view_note(renderer->view, frame->stale);
}

static void draw(Renderer *renderer, const ParticleBuffers *state, GlTimer *timer, ViewCounts *counts)
{
    Frame frame;
    const ParticleBuffers with = derived_of(renderer, state, timer), *particles = &with;
    const ViewKind *kind = renderer->view ? view_kind(renderer->view) : NULL;
    const Target *target = drawn_target(renderer), *shown = &renderer->target;
    const Subject subject = subject_of(renderer);
    const double legend = legend_width_pixels(&renderer->def, &renderer->world, shown->height) / shown->width;
    frame_make(&frame, &subject, particles, target, view_radii(kind, &renderer->def, particles),
               (CoveredParts){renderer->covered.left, fmax(renderer->covered.right, legend)});
    frame.timer = timer;
    frame.counts = counts;
    frame.plain = renderer->plain;
    frame.more = renderer->more;
    frame.stale = renderer->late ? &renderer->stale : NULL;
    frame.floor_light = renderer->shadow.floor_map;
    if (renderer->view)
        view_show(renderer->view, &renderer->def, &frame);
    frame.glass = glass_of(renderer, &frame);
    frame.no_colors = frame.no_colors && !overlays_any(&renderer->overlays);
    memcpy(renderer->range, frame.range, sizeof renderer->range);
    memcpy(renderer->opacity_range, frame.opacity_range, sizeof renderer->opacity_range);
    memcpy(renderer->size_range, frame.size_range, sizeof renderer->size_range);
    frame_uniforms_update(renderer->uniforms, &frame, particles->box_size, particles->spacing);
    overlays_add_state(&renderer->overlays, particles, &subject, timer);
    if (renderer->view)
        view_prepare(renderer->view, particles, &frame);
    GL_STAGE(timer, STAGE_SHADOW)
    {
        draw_shadow(renderer, particles, &frame);
        draw_caustics(renderer, particles, &frame);
    }
    GL_STAGE(timer, STAGE_BACKDROP)
    {
        target_begin(target);
        backdrop_draw(&renderer->backdrop, &frame);
    }
    if (renderer->solids && !frame.no_solids)
        GL_STAGE(timer, STAGE_SOLIDS)
        {
            solids_draw(renderer->solids, &frame);
        }
    draw_panes(renderer, &frame, true);
    draw_over_depth(renderer, particles, &frame);
    if (renderer->view)
        draw_view(renderer, particles, &frame);
    const char *own = note_of(renderer, particles);
    frame.note = frame.note ? frame.note : own;
    draw_panes(renderer, &frame, false);
    draw_overlays(renderer, particles, &frame);
    GL_STAGE(timer, STAGE_OVERLAY)
    draw_over(renderer, particles, &frame);
    picture_probe_set(&renderer->probe, particles, &frame, renderer->uniforms);
    renderer->showed_stale = renderer->stale;
    renderer->flat = frame.flat;
    renderer->stale = false;
}

void renderer_add_state(Renderer *renderer, const ParticleBuffers *state, GlTimer *timer)
{
    const Subject subject = subject_of(renderer);
    const ParticleWants wants = {.scalars =
                                     SCALAR_BIT(view_color_by(&renderer->def))}; /* the only derived scalar
                                                                                    that overlays keep of a
                                                                                    state */
    ParticleBuffers with = *state;
    if (!overlays_keep_states(&renderer->overlays))
        return;
    if ((int)view_color_by(&renderer->def) >= SCALAR_BORN)
        GL_STAGE(timer, STAGE_SCALARS)
        {
            derive(renderer, &wants, &with);
        }
    overlays_add_state(&renderer->overlays, &with, &subject, timer);
}

void renderer_draw(Renderer *renderer, const ParticleBuffers *particles, GlTimer *timer)
{
    draw(renderer, particles, timer, NULL);
}

void renderer_draw_counted(Renderer *renderer, const ParticleBuffers *particles, ViewCounts *counts)
{
    *counts = (ViewCounts){0};
    draw(renderer, particles, NULL, counts);
}

/* A new def or a new size has no picture yet. */
static bool lacks_pixels(const Renderer *renderer)
{
    return is_coarse(renderer) && !renderer->drawn.whole;
}

void renderer_read(Renderer *renderer, uint8_t *rgb)
{
    if (lacks_pixels(renderer))
        make_whole(renderer, renderer->target.framebuffer);
    renderer->drawn.whole = true;
    target_read(&renderer->target, rgb);
}

void renderer_present(Renderer *renderer, int x, int y)
{
    if (lacks_pixels(renderer))
        make_whole(renderer, 0);
    else
        target_present(&renderer->target, x, y);
}

void renderer_read_depth(const Renderer *renderer, float *depth)
{
    if (is_coarse(renderer))
        upscale_depth(&renderer->upscale, &renderer->target);
    target_read_depth(&renderer->target, depth);
}

void renderer_set_presents(Renderer *renderer, bool presents)
{
    renderer->presents = presents;
}

void renderer_set_covered(Renderer *renderer, CoveredParts covered)
{
    renderer->covered = covered;
}

bool renderer_set_title(Renderer *renderer, const Title *title, Error *error)
{
    if (!follow_letters(renderer, has_letters(&renderer->def, title), renderer->target.height, error))
        return false;
    renderer->title = *title;
    return true;
}

size_t renderer_derived_bytes(const Renderer *renderer)
{
    return derived_bytes(&renderer->derived);
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

void renderer_set_late(Renderer *renderer, bool late)
{
    renderer->late = late;
}

bool renderer_is_stale(const Renderer *renderer)
{
    return renderer->showed_stale;
}

void renderer_set_plain(Renderer *renderer, bool plain)
{
    renderer->plain = plain;
}

void renderer_set_continuous(Renderer *renderer, bool more)
{
    const ViewDef said = renderer->said;
    const WorldDef world = renderer->world;
    const bool changes = more != renderer->more && view_quality(&said, true) != view_quality(&said, false);
    Error error;
    renderer->more = more;
    if (changes && !renderer_set_def(renderer, &said, &world, &error)) /* after a failure the old settings
                                                                          stay */
        fprintf(stderr, "%s\n", error.message);
}

bool renderer_is_flat(const Renderer *renderer)
{
    return renderer->flat;
}

bool renderer_unfinished(const Renderer *renderer)
{
    return renderer->more &&
           ((renderer->view && view_unfinished(renderer->view)) || overlays_unfinished(&renderer->overlays));
}

const char *renderer_missing(const Renderer *renderer)
{
    const char *words = renderer->view ? view_missing(renderer->view) : NULL;
    return words || !renderer->derived.lacks ? words : renderer->note;
}

/* Pixels drawn per pixel shown, along each axis. */
static void scale_of(const Renderer *renderer, double scale[2])
{
    const Target *drawn = drawn_target(renderer);
    scale[0] = (double)drawn->width / renderer->target.width;
    scale[1] = (double)drawn->height / renderer->target.height;
}

bool renderer_can_probe(const Renderer *renderer, const double pixel[2])
{
    double scale[2];
    scale_of(renderer, scale);
    const double drawn[] = {scale[0] * pixel[0], scale[1] * pixel[1]};
    return renderer->view && picture_probe_can(&renderer->probe, renderer->view, &renderer->def, drawn);
}

bool renderer_probe(Renderer *renderer, const ViewProbeRequest *asks, ViewProbeAnswers *out)
{
    double scale[2];
    ViewProbeRequest drawn = *asks;
    *out = (ViewProbeAnswers){.count = 0};
    scale_of(renderer, scale);
    for (int k = 0; k < 2; k++)
        drawn.pixel[k] *= scale[k];
    const bool known = renderer->view &&
                       picture_probe_request(&renderer->probe, renderer->view, &renderer->def, &drawn, out);
    for (int i = 0; i < out->count; i++)
        for (int k = 0; k < 2; k++)
            out->probe[i].pixel[k] /= scale[k];
    return known;
}
