#include "render/renderer_private.h"

#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

static const WorldDef unknown;

ViewDef view_def_default(void)
{
    ViewDef def = view_def_shared();
    views_default(&def);
    overlays_default(&def);
    return def;
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

unsigned renderer_attributes(const ViewDef *def)
{
    const unsigned fluid =
        PARTICLE_SCALAR(SCALAR_FLUID); /* as a number; as a colour, the fluid is among the scalars */
    ParticleWants all = {.scalars = UINT64_MAX, .vectors = UINT32_MAX, .attributes = fluid};
    overlays_want(NULL, &all);
    const ParticleWants wants = def ? renderer_wants(def) : all;
    return particle_wants_attributes(&wants);
}

static bool follow_derived(Renderer *renderer, const ViewDef *def, Error *error)
{
    const ParticleWants wants = renderer_wants(def);
    if (!derived_update(&renderer->derived, &wants, error))
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
    if (!target_create(&renderer->target, width, height, error) ||
        !upscale_update(&renderer->upscale, def->resolution, width, height, error))
        return false;
    renderer->uniforms = frame_uniforms_create();
    return follow_derived(renderer, def, error) &&
           follow_letters(renderer, has_letters(def, &renderer->title), height, error) &&
           effects_prepare(&renderer->effects, &subject, error) &&
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
    Error unsaid; /* `error` has the first reason */
    if (!renderer) {
        error_set(error, "out of memory for the renderer");
        return NULL;
    }
    renderer->said = *def;
    renderer->def = view_at_quality(def, false);
    renderer->world = *(world ? world : &unknown);
    keep_freed_memory();
    programs_begin();
    const bool created = create_parts(renderer, width, height, error);
    if (programs_finish(created ? error : &unsaid) && created)
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
    effects_destroy(&renderer->effects);
    ranges_destroy(&renderer->ranges);
    derived_destroy(&renderer->derived);
    glDeleteBuffers(1, &renderer->uniforms);
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
    const bool followed = follow_derived(renderer, def, error) &&
                          effects_prepare(&renderer->effects, &subject, error) &&
                          follow_letters(renderer, letters, renderer->target.height, error) &&
                          upscale_update(&renderer->upscale, def->resolution, renderer->target.width,
                                         renderer->target.height, error) &&
                          follow_view(renderer, &subject, error);
    if (followed) {
        const ParticleWants wants = renderer_wants(def);
        renderer->said = *said;
        renderer->def = *def;
        renderer->world = *subject.world;
        derived_release(&renderer->derived, &wants);
    }
    const Subject drawn_now = subject_of(renderer);
    effects_release(&renderer->effects, &drawn_now);
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

/* A new def or a new size has no picture yet. */
static bool lacks_pixels(const Renderer *renderer)
{
    return is_coarse(renderer) && !renderer->whole;
}

void renderer_read(Renderer *renderer, uint8_t *rgb)
{
    if (lacks_pixels(renderer))
        renderer_make_whole(renderer, renderer->target.framebuffer);
    renderer->whole = true;
    target_read(&renderer->target, rgb);
}

void renderer_present(Renderer *renderer, int x, int y)
{
    if (lacks_pixels(renderer))
        renderer_make_whole(renderer, 0);
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
    const FrameColors *colors = &renderer->picture.frame.colors;
    memcpy(range, colors->range, sizeof colors->range);
}

void renderer_curve_ranges(const Renderer *renderer, double opacity[2], double size[2])
{
    const FrameCurves *curves = &renderer->picture.frame.curves;
    memcpy(opacity, curves->opacity, sizeof curves->opacity);
    memcpy(size, curves->size, sizeof curves->size);
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
    return renderer->picture.frame.flat;
}

bool renderer_unfinished(const Renderer *renderer)
{
    return renderer->more &&
           ((renderer->view && view_unfinished(renderer->view)) || overlays_unfinished(&renderer->overlays));
}

bool renderer_can_improve(const Renderer *renderer)
{
    const ViewKind *kind = view_find(renderer->said.kind);
    return renderer->said.quality == VIEW_AUTO && (!kind || kind->quality || !kind->samples);
}

bool renderer_keeps_states(const Renderer *renderer)
{
    return overlays_keep_states(&renderer->overlays);
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
