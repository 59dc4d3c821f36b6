#include "render/views/slice/slice.h"

#include "render/frame/frame.h"
#include "render/frame/passes.h"
#include "render/particles/particles.h"
#include "render/views/slice/slice_private.h"
#include "shaders/shared/bindings.h"
#include "shaders/slice/slice_bindings.h"
#include "sim/base/key_rows.h"
#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const show_names[] = {[SLICE_PLANE] = "plane", [SLICE_FLAT] = "flat", NULL};

static const char *const particles_names[] = {
    [SLICE_ALONE] = "none", [SLICE_BEHIND] = "behind", [SLICE_BOTH] = "both", NULL};

/* The amount of fluid, sum V W. */
static const char FIELD[] = "field";

const SliceDef slice_usual = {.normal = {0, 0, 1}, .samples = 512, .cut = 0.25, .opacity = 1};

#define AT(field) offsetof(SliceDef, field)

/* clang-format off */
const Key slice_keys[] = {
    MAPPING("view.slice", "of the view slice: a scalar on a plane through the fluid"),
    VEC3("view.slice.point", L, "m", -1e6, 1e6, AT(point), "that the plane goes through, in the box's frame; two dimensions have one plane only"),
    VEC3("view.slice.normal", L, "", -1e6, 1e6, AT(normal), "across the plane, of any length but 0"),
    NUMBER("view.slice.play", L, "m/s", -1e3, 1e3, AT(play), "the plane goes along its normal, to and fro through the box, in simulated time; it begins at point"),
    CHOICE_OF("view.slice.show", L | KEY_INDEX, show_names, AT(show), "plane: where it is in the box; flat: filling the picture"),
    CHOICE_OF("view.slice.kernel", L | KEY_INDEX, plane_kernels, AT(kernel), "that sums are made with; its support radius is the solver's"),
    BOOLEAN("view.slice.raw", L, AT(raw), "sum V W s as it is; else over sum V W, the mean that is right near the surface too"),
    INTEGER("view.slice.samples", L, 16, 8192, AT(samples), "along the longer side where it is shown in the box; flat has one a pixel"),
    NUMBER("view.slice.cut", L, "", 0, 1, AT(cut), "where sum V W is less there is no fluid to be shown; a plane surface has 0.5"),
    CHOICE_OF("view.slice.particles", L | KEY_INDEX | KEY_REBUILD, particles_names, AT(particles), "shown with the plane in three dimensions; behind: those that its normal points away from"),
    NUMBER("view.slice.opacity", L, "", 0, 1, AT(opacity), "of the plane where it is in the box"),
    INTEGER("view.slice.isolines", L, 0, 100, AT(isolines), "lines of equal value between the ends of the range"),
    KEYS_END,
};
/* clang-format on */

const ViewGrade slice_grades[] = {
    {"view.slice.samples", {"64", "128", "256", "512", "1024"}, NULL, NULL, false},
    {0},
};

typedef struct SliceView {
    PlaneSum sum, veil; /* sums of the scalar shown; sums of the opacity's scalar, if different */
    SliceTints tints;   /* with `sum`, the sums of the fluids' colours */
    unsigned program, vertex_array;
    ColorTable colors;
    bool has_scalar; /* the particles have the scalar shown */
    bool by_fluid;   /* shows the fluids' colours */
    SliceProbe probe;
    View *balls; /* draws particles beside the plane; NULL: no particles shown */
    ViewDef balls_def;
    ParticleClip half;
    ParticleBuffers shown; /* particles shown in this picture */
} SliceView;

static void destroy(void *state)
{
    SliceView *view = state;
    plane_sum_destroy(&view->sum);
    plane_sum_destroy(&view->veil);
    slice_tints_destroy(&view->tints);
    plane_probe_destroy(&view->probe.probe);
    glDeleteProgram(view->program);
    glDeleteVertexArrays(1, &view->vertex_array);
    color_table_destroy(&view->colors);
    view_destroy(view->balls);
    particle_clip_destroy(&view->half);
    free(view);
}

static bool check(const Subject *subject, const char **key, Error *error)
{
    const double *normal = slice_def(subject->def)->normal;
    *key = "view.slice.normal";
    return normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2] > 0 ||
           error_set(error, "a normal of length 0 is across no plane; [0, 0, 1] looks along z");
}

/* Settings of the list's first view, with the slice's colours; the def's opacity is for the plane. */
static void follow_def(SliceView *view, const ViewDef *def)
{
    view->balls_def = *def;
    view->balls_def.opacity.by = view->balls_def.size.by = 0;
    snprintf(view->balls_def.kind, sizeof view->balls_def.kind, "%s", view_at(0)->name);
}

static bool create_balls(SliceView *view, const Subject *subject, Error *error)
{
    const Subject balls = {&view->balls_def, subject->world};
    if (slice_def(subject->def)->particles == SLICE_ALONE)
        return true;
    follow_def(view, subject->def);
    view->balls = view_create(&balls, error);
    return view->balls && particle_clip_create(&view->half, error);
}

static void *create(const Subject *subject, Error *error)
{
    static const char *const stages[] = {"slice/slice_show.vert", "slice/slice_show.frag", NULL};
    SliceView *view = calloc(1, sizeof *view);
    if (!view) {
        error_set(error, "out of memory for the view");
        return NULL;
    }
    glCreateVertexArrays(1, &view->vertex_array);
    if (color_table_create(&view->colors, view_colormap(subject->def), &subject->def->color_curve, error))
        view->program = program_create("slice show", stages,
                                       subject->def->opacity.by ? "#define VEILED 1\n" : NULL, error);
    const int kernel = plane_kernel_of(slice_def(subject->def)->kernel, subject->world);
    if (view->program && plane_sum_prepare(&view->sum, kernel, error) && create_balls(view, subject, error))
        return view;
    destroy(view);
    return NULL;
}

/* The picture's width without the legend, pixels. */
static double flat_width(const Frame *frame)
{
    const double legend = legend_width_pixels(frame->def, frame->world, frame->height);
    return fmax(frame->width - legend, frame->width / 2.0);
}

/* A raster with a sample per pixel. */
static void flat_samples(const Plane *plane, const Frame *frame, int samples[2])
{
    const double scale = fmin(flat_width(frame) / plane->size[0], frame->height / plane->size[1]);
    for (int k = 0; k < 2; k++)
        samples[k] = (int)fmax(floor(plane->size[k] * scale + 1e-9), 1);
}

static void plane_samples(const Plane *plane, int most, int samples[2])
{
    const double scale = most / fmax(plane->size[0], plane->size[1]);
    for (int k = 0; k < 2; k++)
        samples[k] = (int)fmax(ceil(plane->size[k] * scale - 1e-6), 1);
}

/* Particles smaller than a sample could be missed: the kernel always reaches at least one sample. */
static double support_of(const PlaneJob *job, const ParticleBuffers *particles)
{
    const double across = hypot(job->plane.size[0] / job->samples[0], job->plane.size[1] / job->samples[1]);
    return fmax(particles->support_radius, 0.75 * across);
}

static bool make_job(const ParticleBuffers *particles, const Frame *frame, PlaneJob *job)
{
    const SliceDef *def = slice_def(frame->def);
    *job = (PlaneJob){.kernel = plane_kernel_of(def->kernel, frame->world),
                      .dimensions = frame->slab > 0 ? 2 : 3,
                      .scalar = view_color_by(frame->def)};
    if (!slice_plane(def, particles, &job->plane))
        return false;
    if (def->show == SLICE_FLAT)
        flat_samples(&job->plane, frame, job->samples);
    else
        plane_samples(&job->plane, def->samples, job->samples);
    job->support = support_of(job, particles);
    return true;
}

static void set_filter(unsigned texture, GLint filter)
{
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, filter);
    glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, filter);
}

static void set_filters(const SliceView *view, GLint filter)
{
    set_filter(view->sum.sums, filter);
    if (view->by_fluid) {
        set_filter(view->tints.green.sums, filter);
        set_filter(view->tints.blue.sums, filter);
    }
}

/* A flat slice has an empty background. */
static void clear_flat(const Frame *frame)
{
    const double *back = frame->def->background;
    const GLfloat color[4] = {(GLfloat)back[0], (GLfloat)back[1], (GLfloat)back[2], 1};
    glDisable(GL_SCISSOR_TEST);
    glClearNamedFramebufferfv(frame->target->framebuffer, GL_COLOR, 0, color);
    glClearNamedFramebufferfv(frame->target->framebuffer, GL_DEPTH, 0, (float[1]){0});
}

/* Rectangle of a flat slice in the picture: x, y from below, width, height. */
static void flat_part(const PlaneJob *job, const Frame *frame, int part[4])
{
    part[0] = ((int)flat_width(frame) - job->samples[0]) / 2;
    part[1] = (frame->height - job->samples[1]) / 2;
    part[2] = job->samples[0];
    part[3] = job->samples[1];
}

/* Draws with a sample per pixel. */
static void begin_flat(const SliceView *view, const PlaneJob *job, const Frame *frame)
{
    int part[4];
    flat_part(job, frame, part);
    glDisable(GL_DEPTH_TEST);
    glViewport(part[0], part[1], part[2], part[3]);
    set_filters(view, GL_NEAREST);
}

static void begin_in_space(const SliceView *view, const Frame *frame)
{
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_TRUE);
    glViewport(0, 0, frame->width, frame->height);
    set_filters(view, GL_LINEAR);
}

/* The plane hides objects behind, and no pixel is drawn twice. */
static void begin_blending(void)
{
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
}

/* If colours are the only fluid's, or the particles lack the scalar, the slice shows the amount of fluid. */
static unsigned what_is_shown(const SliceView *view, const Frame *frame)
{
    if (view->by_fluid)
        return SLICE_TINTS;
    if (!view->has_scalar)
        return SLICE_FIELD;
    return slice_def(frame->def)->raw ? SLICE_RAW : SLICE_MEAN;
}

/* Sums for opacity by a scalar; NULL: particles lack the scalar, and the opacity is constant. */
static PlaneSum *sum_veil(SliceView *view, const PlaneJob *job, const ParticleBuffers *particles,
                          const Frame *frame)
{
    const Scalar scalar = scalar_of_curve(&frame->def->opacity);
    PlaneJob own = *job;
    Error error;
    if (!particles->scalar[scalar].buffer)
        return NULL;
    if (view->has_scalar && scalar == job->scalar)
        return &view->sum;
    own.scalar = scalar;
    return plane_sum_run(&view->veil, &own, particles, &error) ? &view->veil : NULL;
}

static void set_veil(const SliceView *view, const PlaneSum *veils, const Frame *frame)
{
    particle_curve_set(&frame->def->opacity, frame->curves.opacity, 1, veils != NULL);
    glBindTextureUnit(VEIL_UNIT, veils ? veils->sums : view->sum.sums);
    if (veils == &view->veil)
        set_filter(veils->sums, slice_def(frame->def)->show == SLICE_FLAT ? GL_NEAREST : GL_LINEAR);
}

/* `veils`: result of sum_veil. */
static void show_sums(SliceView *view, const PlaneJob *job, const PlaneSum *veils, const Frame *frame)
{
    const bool veiled = frame->def->opacity.by != 0;
    const SliceDef *def = slice_def(frame->def);
    const bool flat = def->show == SLICE_FLAT;
    glBindFramebuffer(GL_FRAMEBUFFER, frame->target->framebuffer);
    glDisable(GL_BLEND);
    if (flat)
        begin_flat(view, job, frame);
    else {
        begin_in_space(view, frame);
    }
    if (veiled || (!flat && def->opacity < 1))
        begin_blending();
    glUseProgram(view->program);
    if (veiled)
        set_veil(view, veils, frame);
    glUniform1ui(FLAT_AT, flat);
    glUniform1ui(SHOWN_AT, what_is_shown(view, frame));
    glUniform1f(CUT_AT, (float)def->cut);
    glUniform1ui(ISOLINES_AT, (GLuint)def->isolines);
    glUniform1f(OPACITY_AT, flat ? 1 : (float)def->opacity);
    glBindTextureUnit(SUMS_UNIT, view->sum.sums);
    glBindTextureUnit(GREEN_UNIT, view->by_fluid ? view->tints.green.sums : view->sum.sums);
    glBindTextureUnit(BLUE_UNIT, view->by_fluid ? view->tints.blue.sums : view->sum.sums);
    color_table_bind(&view->colors, &frame->def->color_curve);
    glBindVertexArray(view->vertex_array);
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    glDisable(GL_BLEND);
}

static bool shows_balls(const SliceView *view, const Frame *frame)
{
    return view->balls && slice_def(frame->def)->show == SLICE_PLANE && !(frame->slab > 0);
}

/* Balls behind the plane only touch the plane. */
static void find_shown(SliceView *view, const ParticleBuffers *particles, const Frame *frame)
{
    const SliceDef *def = slice_def(frame->def);
    Plane plane;
    double most = -(double)frame->radii.drawn;
    view->shown = *particles;
    if (def->particles != SLICE_BEHIND)
        return;
    slice_plane(def, particles, &plane); /* position and axes are valid in any case */
    for (int k = 0; k < 3; k++)
        most += plane.corner[k] * plane.normal[k];
    particle_clip_run(&view->half, particles, plane.normal, most, &view->shown);
}

/* The frame for the view that draws the balls. */
static Frame frame_of_balls(SliceView *view, const Frame *frame)
{
    Frame own = *frame;
    own.def = &view->balls_def;
    return own;
}

static void prepare(void *state, const ParticleBuffers *particles, const Frame *frame)
{
    SliceView *view = state;
    if (!shows_balls(view, frame))
        return;
    follow_def(view, frame->def);
    GL_STAGE(frame->timer, STAGE_VISIBILITY)
    find_shown(view, particles, frame);
    const Frame own = frame_of_balls(view, frame);
    view_prepare(view->balls, &view->shown, &own);
}

static void cast(void *state, const ParticleBuffers *particles, const Frame *frame)
{
    SliceView *view = state;
    (void)particles;
    if (!shows_balls(view, frame))
        return;
    const Frame own = frame_of_balls(view, frame);
    view_cast(view->balls, &view->shown, &own);
}

static void draw_balls(SliceView *view, const Frame *frame)
{
    if (!shows_balls(view, frame))
        return;
    const Frame own = frame_of_balls(view, frame);
    view_draw(view->balls, &view->shown, &own);
}

static bool same3(const double a[3], const double b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

static bool same_plane(const Plane *a, const Plane *b)
{
    return same3(a->corner, b->corner) && same3(a->along, b->along) && same3(a->up, b->up) &&
           a->size[0] == b->size[0] && a->size[1] == b->size[1];
}

/* True if the sums are unchanged: a picture drawn again while nothing moves. */
static bool same_sums(const SliceProbe *probe, const PlaneJob *job, const PlaneSource *from)
{
    const PlaneJob *was = &probe->job;
    return same_plane(&was->plane, &job->plane) && was->samples[0] == job->samples[0] &&
           was->samples[1] == job->samples[1] && was->kernel == job->kernel && was->scalar == job->scalar &&
           was->support == job->support && probe->from.step == from->step && probe->from.time == from->time &&
           probe->from.count == from->count && probe->from.position.buffer == from->position.buffer &&
           probe->from.position.offset == from->position.offset;
}

/* Stores the inputs of later probes. */
static void remember(SliceView *view, const PlaneJob *job, const ParticleBuffers *particles,
                     const Frame *frame)
{
    const SliceDef *def = slice_def(frame->def);
    SliceProbe *probe = &view->probe;
    const PlaneSource from = {particles->step, particles->time, particles->count, particles->position};
    const unsigned shown = what_is_shown(view, frame);
    if (!same_sums(probe, job, &from) || probe->shown != shown || probe->cut != def->cut)
        probe->run++;
    probe->job = *job;
    probe->from = from;
    probe->sight = (Sight){frame->camera, particles->box, frame->width, frame->height, 0};
    probe->flat = def->show == SLICE_FLAT;
    probe->shown = shown;
    probe->cut = def->cut;
    probe->name = view->by_fluid ? FIELD : frame->colors.name;
    probe->unit = frame->colors.unit;
    flat_part(job, frame, probe->part);
}

static const char *note(void *state, bool *stale)
{
    SliceView *view = state;
    return !view->probe.drawn                  ? "the plane misses the box"
           : plane_sum_none(&view->sum, stale) ? "no fluid on the plane"
                                               : NULL;
}

static bool pick(const void *state, const double pixel[2], double at[3])
{
    const SliceView *view = state;
    return slice_probe_pick(&view->probe, pixel, at);
}

static int probe(void *state, const double (*at)[3], int count, ViewProbe *out)
{
    SliceView *view = state;
    return slice_probe_read(&view->probe, &view->sum, at, count, out);
}

static bool sum_up(SliceView *view, const PlaneJob *job, const ParticleBuffers *particles,
                   const WorldDef *world, Error *error)
{
    return view->by_fluid ? slice_tints_run(&view->tints, &view->sum, job, particles, world, error)
                          : plane_sum_run(&view->sum, job, particles, error);
}

static void draw(void *state, const ParticleBuffers *particles, const Frame *frame)
{
    SliceView *view = state;
    PlaneJob job;
    Error error;
    bool made = false;
    draw_balls(view, frame);
    view->has_scalar =
        view_color_by(frame->def) != SCALAR_FLUID && particles->scalar[view_color_by(frame->def)].buffer != 0;
    view->by_fluid = slice_tints_shown(particles, frame);
    const PlaneSum *veils = NULL;
    GL_STAGE(frame->timer, STAGE_BLEND)
    {
        made = make_job(particles, frame, &job) && sum_up(view, &job, particles, frame->world, &error);
        if (made && frame->def->opacity.by != 0)
            veils = sum_veil(view, &job, particles, frame);
    }
    view->probe.drawn = made;
    if (made)
        remember(view, &job, particles, frame);
    GL_STAGE(frame->timer, STAGE_SHADE)
    {
        if (slice_def(frame->def)->show == SLICE_FLAT)
            clear_flat(frame);
        if (made) /* false: the plane misses the box, or memory that was there may be gone */
            show_sums(view, &job, veils, frame);
    }
}

/* The field is 1 in a fluid at rest, more in compressed fluid. */
static void show(const ViewDef *def, Frame *frame)
{
    const SliceDef *own = slice_def(def);
    frame->flat = own->show == SLICE_FLAT;
    const bool tints = view_color_by(def) == SCALAR_FLUID && frame->world->fluid_count > 1 &&
                       frame->colors.fluids_known; /* as slice_tints_shown */
    if (!frame->colors.by_fluid || tints)
        return;
    frame->colors.by_fluid =
        own->particles != SLICE_ALONE && !frame->flat; /* balls have the fluids' colours */
    frame->colors.name = FIELD;
    frame->colors.unit = "";
    frame->colors.range[0] = 0;
    frame->colors.range[1] = 1.25;
    frame->colors.beyond[0] = frame->colors.beyond[1] = false;
}

const ViewKind view_slice = {
    .name = "slice",
    .help = "a scalar on a plane through the fluid, exact in each sample",
    .radius = 0.5,
    .curves = VIEW_OPACITY,
    .keys = slice_keys,
    .grades = slice_grades,
    .def = &slice_usual,
    .def_size = sizeof slice_usual,
    .check = check,
    .create = create,
    .destroy = destroy,
    .prepare = prepare,
    .show = show,
    .cast = cast,
    .draw = draw,
    .handles = slice_handles,
    .drag = slice_drag,
    .step = slice_step,
    .note = note,
    .pick = pick,
    .probe = probe,
};
