/* One picture: the inputs of its effects, and drawing them. */
#include "render/renderer_private.h"

#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

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

ParticleWants renderer_wants(const ViewDef *def)
{
    ParticleWants wants = {.scalars = SCALAR_BIT(view_color_by(def))};
    effects_want(def, &wants);
    want_curve(&wants, &def->opacity);
    want_curve(&wants, &def->size);
    if (def->opacity.by != 0)
        wants.attributes |= PARTICLE_SCALAR(SCALAR_ID);
    return wants;
}

/* What the renderer may have changed since the picture. */
static void set_owned(const Renderer *renderer, Picture *picture)
{
    picture->view = renderer->view;
    picture->text = renderer->text;
}

void renderer_make_whole(Renderer *renderer, GLuint framebuffer)
{
    const Picture *last = &renderer->picture;
    Picture whole = *last;
    set_owned(renderer, &whole);
    whole.particles = NULL;
    whole.framebuffer = framebuffer;
    if (!is_coarse(renderer)) {
        effects_draw_whole(&whole);
        return;
    }
    whole.coarse = &renderer->upscale;
    whole.frame.width = renderer->target.width;
    whole.frame.height = renderer->target.height;
    whole.frame.fineness = 1;
    frame_uniforms_update(renderer->uniforms, &whole.frame, last->box_size, last->spacing);
    effects_draw_whole(&whole);
    frame_uniforms_update(renderer->uniforms, &last->frame, last->box_size, last->spacing); /* for probes */
    glEnable(GL_FRAMEBUFFER_SRGB);
}

/* True if a picture by `def` needs derived data. */
static bool derives(const ViewDef *def)
{
    const ParticleWants wants = renderer_wants(def);
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
    const ParticleWants wants = renderer_wants(&renderer->def);
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

/* Makes the picture's frame for drawing into `target`. */
static void make_frame(Renderer *renderer, const Subject *subject, const Target *target, Picture *picture)
{
    Frame *frame = &picture->frame;
    const ViewKind *kind = renderer->view ? view_kind(renderer->view) : NULL;
    const Target *shown = &renderer->target;
    const CoveredParts legend = legend_room(subject->def, subject->world, shown->width, shown->height);
    frame_make(frame, subject, picture->particles, target, view_radii(kind, subject->def, picture->particles),
               covered_by_both(renderer->covered, legend));
    frame->fineness = fmaxf(1, (float)target->height / (float)shown->height);
    frame->plain = renderer->plain;
    frame->more = renderer->more;
    frame->neighbourhood = &renderer->derived.neighbourhood;
    frame->stale = renderer->late ? &renderer->stale : NULL;
    if (renderer->view)
        view_show(renderer->view, subject->def, frame);
    frame->colors.none = frame->colors.none && !overlays_any(&renderer->overlays);
}

static void begin_picture(Renderer *renderer, const Subject *subject, const ParticleBuffers *particles)
{
    Picture *picture = &renderer->picture;
    *picture = (Picture){.particles = particles,
                         .overlays = &renderer->overlays,
                         .derived = &renderer->derived,
                         .states = &renderer->effects,
                         .title = &renderer->title,
                         .time = particles->time,
                         .spacing = particles->spacing};
    memcpy(picture->box_size, particles->box_size, sizeof picture->box_size);
    quat_rotate(particles->box.orientation, particles->gravity, picture->gravity);
    set_owned(renderer, picture);
    make_frame(renderer, subject, drawn_target(renderer), picture);
}

/* Draws the effects in full resolution, unless they wait until the picture is presented. */
static void end_picture(Renderer *renderer)
{
    Picture *picture = &renderer->picture;
    const char *own = note_of(renderer, picture->particles);
    if (renderer->view && renderer->def.legend) /* may wait for the GPU */
        picture->note = view_note(renderer->view, picture->frame.stale);
    picture->note = picture->note ? picture->note : own;
    renderer->whole = !is_coarse(renderer) || !renderer->presents;
    GL_STAGE(picture->frame.timer, STAGE_OVERLAY)
    {
        if (renderer->whole)
            renderer_make_whole(renderer, renderer->target.framebuffer);
    }
    picture_probe_set(&renderer->probe, picture->particles, &picture->frame, renderer->uniforms);
    picture->particles = NULL;
}

static void draw(Renderer *renderer, const ParticleBuffers *state, GlTimer *timer, ViewCounts *counts)
{
    const ParticleBuffers with = derived_of(renderer, state, timer);
    const Subject subject = subject_of(renderer);
    Picture *picture = &renderer->picture;
    begin_picture(renderer, &subject, &with);
    picture->frame.timer = timer;
    picture->frame.counts = counts;
    frame_uniforms_update(renderer->uniforms, &picture->frame, with.box_size, with.spacing);
    overlays_add_state(&renderer->overlays, &with, &subject, timer);
    if (renderer->view)
        view_prepare(renderer->view, &with, &picture->frame);
    effects_draw(picture);
    end_picture(renderer);
    neighbourhood_forget(&renderer->derived.neighbourhood);
    renderer->showed_stale = renderer->stale;
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
    neighbourhood_forget(&renderer->derived.neighbourhood);
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
