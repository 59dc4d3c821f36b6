#include "render/views/slice/slice_private.h"
#include "shaders/slice/slice_bindings.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double STEP_SHARE = 0.02;         /* fraction of the box's extent along the normal */
static const double STEP_TURN = M_PI / 36;     /* radians */
static const double ARROW = 0.22, RING = 0.09; /* fractions of the box's diagonal */

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* out = a + times b */
static void add(const double a[3], double times, const double b[3], double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = a[k] + times * b[k];
}

static void unit_normal(const SliceDef *def, double normal[3])
{
    const double length = sqrt(dot(def->normal, def->normal));
    for (int k = 0; k < 3; k++)
        normal[k] = def->normal[k] / length;
}

/* The box's extent along the unit normal, m. */
static void plane_extent(const double size[3], const double normal[3], double *low, double *high)
{
    const double middle = normal[1] * size[1] / 2,
                 half =
                     (fabs(normal[0]) * size[0] + fabs(normal[1]) * size[1] + fabs(normal[2]) * size[2]) / 2;
    *low = middle - half;
    *high = middle + half;
}

/* Moves to and fro between 0 and `width`. */
static double fold_way(double x, double width)
{
    const double in_period = x - 2 * width * floor(x / (2 * width));
    return in_period > width ? 2 * width - in_period : in_period;
}

void slice_point(const SliceDef *def, const double box_size[3], double time, double point[3])
{
    double normal[3], low, high;
    memcpy(point, def->point, sizeof(double[3]));
    if (def->play == 0)
        return;
    unit_normal(def, normal);
    plane_extent(box_size, normal, &low, &high);
    const double here = dot(point, normal), began = fmin(fmax(here, low), high) - low;
    const double now = low + fold_way(began + def->play * time, high - low);
    add(point, now - here, normal, point);
}

static bool is_flat_scene(const ParticleBuffers *particles)
{
    return frame_slab_depth(particles) > 0;
}

bool slice_plane(const SliceDef *def, const ParticleBuffers *particles, Plane *plane)
{
    static const double origin[3], across[3] = {0, 0, 1};
    double point[3];
    slice_point(def, particles->box_size, particles->time, point);
    const bool flat = is_flat_scene(particles);
    return plane_make(particles->box_size, flat ? origin : point, flat ? across : def->normal, plane);
}

/* ---- handles ---- */

enum { SHIFT, SLIDE, TURN, HANDLES };

/* The point itself, or the nearest point of the rectangle. */
static void middle_of(const Plane *plane, const double point[3], double middle[3])
{
    double from[3];
    add(point, -1, plane->corner, from);
    const double x = fmin(fmax(dot(from, plane->along), 0), plane->size[0]),
                 y = fmin(fmax(dot(from, plane->up), 0), plane->size[1]);
    add(plane->corner, x, plane->along, middle);
    add(middle, y, plane->up, middle);
}

int slice_handles(const ViewDef *view, const ParticleBuffers *particles, Handle handles[HANDLES_MAX])
{
    const SliceDef *def = slice_def(view);
    const double *size = particles->box_size, diagonal = sqrt(dot(size, size));
    double point[3], middle[3];
    Plane plane;
    slice_point(def, size, particles->time, point);
    if (def->show != SLICE_PLANE || is_flat_scene(particles) || !slice_plane(def, particles, &plane))
        return 0;
    middle_of(&plane, point, middle);
    handles[SHIFT] = (Handle){"shifts the plane along its normal", HANDLE_DOT, HANDLE_ALONG, {0}, {0}, {0}};
    handles[SLIDE] =
        (Handle){"shifts the handles within the plane", HANDLE_RING, HANDLE_WITHIN, {0}, {0}, {0}};
    handles[TURN] = (Handle){"turns the plane", HANDLE_ARROW, HANDLE_AROUND, {0}, {0}, {0}};
    const double arms[HANDLES] = {[SLIDE] = RING * diagonal, [TURN] = ARROW * diagonal};
    for (int i = 0; i < HANDLES; i++) {
        memcpy(handles[i].from, middle, sizeof middle);
        memcpy(handles[i].axis, plane.normal, sizeof plane.normal);
        add(middle, arms[i], i == SLIDE ? plane.along : plane.normal, handles[i].at);
    }
    return HANDLES;
}

/* ---- settings ---- */

static void set_vector(ViewSetting *setting, const char *path, const double value[3])
{
    snprintf(setting->text, sizeof setting->text, "%s=[%.6g, %.6g, %.6g]", path, value[0], value[1],
             value[2]);
}

/* Taking a moving plane stops the motion. */
static int set_point(const SliceDef *def, const double point[3], ViewSetting settings[VIEW_SETTINGS_MAX])
{
    set_vector(&settings[0], "view.slice.point", point);
    if (def->play == 0)
        return 1;
    snprintf(settings[1].text, sizeof settings[1].text, "view.slice.play=0");
    return 2;
}

static int set_plane(const SliceDef *def, const double point[3], const double normal[3],
                     ViewSetting settings[VIEW_SETTINGS_MAX])
{
    const int count = set_point(def, point, settings);
    set_vector(&settings[count], "view.slice.normal", normal);
    return count + 1;
}

/* Keeps the plane in the box. */
static void keep_in_box(const double size[3], const double normal[3], double point[3])
{
    double low, high;
    plane_extent(size, normal, &low, &high);
    const double here = dot(point, normal), margin = 1e-3 * (high - low);
    add(point, fmin(fmax(here, low + margin), high - margin) - here, normal, point);
}

int slice_drag(const ViewDef *view, const ParticleBuffers *particles, int index, const Handle *taken,
               const double at[3], ViewSetting settings[VIEW_SETTINGS_MAX])
{
    const SliceDef *def = slice_def(view);
    double point[3], moved[3], normal[3];
    add(at, -1, taken->at, moved);
    add(taken->from, 1, moved, point);
    if (index == TURN) {
        add(at, -1, taken->from, normal);
        const double length = sqrt(dot(normal, normal));
        for (int k = 0; k < 3; k++)
            normal[k] /= length;
        return set_plane(def, taken->from, normal, settings);
    }
    keep_in_box(particles->box_size, taken->axis, point);
    return set_point(def, point, settings);
}

static int shift(const SliceDef *def, const double size[3], double point[3], double by,
                 ViewSetting settings[VIEW_SETTINGS_MAX])
{
    double normal[3], low, high;
    unit_normal(def, normal);
    plane_extent(size, normal, &low, &high);
    add(point, by * (high - low), normal, point);
    keep_in_box(size, normal, point);
    return set_point(def, point, settings);
}

static int turn(const SliceDef *def, const double point[3], const double toward[3], double angle,
                ViewSetting settings[VIEW_SETTINGS_MAX])
{
    double normal[3];
    unit_normal(def, normal);
    for (int k = 0; k < 3; k++)
        normal[k] = cos(angle) * normal[k] + sin(angle) * toward[k];
    return set_plane(def, point, normal, settings);
}

int slice_step(const ViewDef *view, const ParticleBuffers *particles, ViewStep step,
               ViewSetting settings[VIEW_SETTINGS_MAX])
{
    const SliceDef *def = slice_def(view);
    double point[3], axis[3] = {step == VIEW_STEP_X, step == VIEW_STEP_Y, step == VIEW_STEP_Z};
    Plane plane;
    if (is_flat_scene(particles))
        return 0;
    slice_point(def, particles->box_size, particles->time, point);
    slice_plane(def, particles, &plane); /* the axes are valid in any case */
    switch (step) {
    case VIEW_STEP_BACK:
        return shift(def, particles->box_size, point, -STEP_SHARE, settings);
    case VIEW_STEP_FORWARD:
        return shift(def, particles->box_size, point, STEP_SHARE, settings);
    case VIEW_STEP_LEFT:
        return turn(def, point, plane.along, -STEP_TURN, settings);
    case VIEW_STEP_RIGHT:
        return turn(def, point, plane.along, STEP_TURN, settings);
    case VIEW_STEP_UP:
        return turn(def, point, plane.up, STEP_TURN, settings);
    case VIEW_STEP_DOWN:
        return turn(def, point, plane.up, -STEP_TURN, settings);
    default: /* a level plane at the floor would show nothing */
        particles_middle(particles, point);
        return set_plane(def, point, axis, settings);
    }
}

_Static_assert((int)VIEW_PROBES_MAX <= (int)PLANE_PROBES_MAX, "all that may be asked of a view has room");

/* `samples`: position on the rectangle, in samples. Returns the distance from the plane, m. */
static double on_plane(const PlaneJob *job, const double at[3], double samples[2])
{
    const Plane *plane = &job->plane;
    double away = 0;
    samples[0] = samples[1] = 0;
    for (int k = 0; k < 3; k++) {
        const double from = at[k] - plane->corner[k];
        samples[0] += from * plane->along[k] * job->samples[0] / plane->size[0];
        samples[1] += from * plane->up[k] * job->samples[1] / plane->size[1];
        away += from * plane->normal[k];
    }
    return fabs(away);
}

static void place_of(const Plane *plane, const double share[2], double at[3])
{
    for (int k = 0; k < 3; k++)
        at[k] = plane->corner[k] + share[0] * plane->size[0] * plane->along[k] +
                share[1] * plane->size[1] * plane->up[k];
}

bool slice_probe_pick(const SliceProbe *probe, const double pixel[2], double at[3])
{
    const int *part = probe->part;
    double samples[2];
    SightRay ray;
    if (!probe->drawn)
        return false;
    if (probe->flat)
        place_of(&probe->job.plane,
                 (const double[2]){(pixel[0] - part[0]) / part[2],
                                   (probe->sight.height - pixel[1] - part[1]) / part[3]},
                 at);
    else {
        sight_ray(&probe->sight, pixel, &ray);
        if (!sight_ray_plane(&ray, probe->job.plane.corner, probe->job.plane.normal, at))
            return false;
    }
    on_plane(&probe->job, at, samples);
    return samples[0] >= 0 && samples[0] < probe->job.samples[0] && samples[1] >= 0 &&
           samples[1] < probe->job.samples[1];
}

static bool pixel_of(const SliceProbe *probe, const double at[3], double pixel[2])
{
    const int *part = probe->part;
    double samples[2];
    if (!probe->flat)
        return sight_pixel(&probe->sight, at, pixel);
    on_plane(&probe->job, at, samples);
    pixel[0] = part[0] + samples[0] * part[2] / probe->job.samples[0];
    pixel[1] = probe->sight.height - (part[1] + samples[1] * part[3] / probe->job.samples[1]);
    return true;
}

/* The sample at a position; -1, -1 outside the rectangle, or if the position is more than half a sample
   off the plane. */
static void sample_of(const PlaneJob *job, const double at[3], int sample[2])
{
    double samples[2];
    const double side = fmax(job->plane.size[0] / job->samples[0], job->plane.size[1] / job->samples[1]);
    bool off = on_plane(job, at, samples) > side / 2;
    for (int k = 0; k < 2; k++)
        off |= !(samples[k] >= 0 && samples[k] < job->samples[k]);
    for (int k = 0; k < 2; k++)
        sample[k] = off ? -1 : (int)samples[k];
}

static void answer(const SliceProbe *probe, int index, ViewProbe *out)
{
    const PlaneProbeRequest *probes = &probe->probe.probes;
    const float *sums = probe->probe.sums[index];
    const double field = (double)sums[1] + sums[2];
    *out = (ViewProbe){
        .now = probes->run == probe->run, .name = probes->name, .unit = probes->unit, .id = VIEW_NO_ID};
    memcpy(out->at, probes->at[index], sizeof out->at);
    out->seen = pixel_of(probe, out->at, out->pixel);
    if (probes->sample[index][0] < 0)
        out->what = VIEW_PROBE_OFF;
    else if (plane_empty(sums) || field < probes->cut)
        out->what = VIEW_PROBE_EMPTY;
    else {
        out->value = probes->shown >= SLICE_FIELD ? field : plane_value(sums, probes->shown == SLICE_RAW);
        out->what = isnan(out->value) ? VIEW_PROBE_NAN : VIEW_PROBE_VALUE;
    }
}

int slice_probe_read(SliceProbe *probe, const PlaneSum *sum, const double (*at)[3], int count, ViewProbe *out)
{
    PlaneProbeRequest probes = {.count = count < PLANE_PROBES_MAX ? count : PLANE_PROBES_MAX,
                                .run = probe->run,
                                .shown = probe->shown,
                                .cut = probe->cut,
                                .name = probe->name,
                                .unit = probe->unit};
    if (!probe->drawn)
        return 0;
    for (int i = 0; i < probes.count; i++) {
        memcpy(probes.at[i], at[i], sizeof probes.at[i]);
        sample_of(&probe->job, at[i], probes.sample[i]);
    }
    plane_probe_request(&probe->probe, sum, &probes);
    const int answered = probe->probe.probes.count;
    for (int i = 0; i < answered && i < probes.count; i++)
        answer(probe, i, &out[i]);
    return answered < probes.count ? answered : probes.count;
}
