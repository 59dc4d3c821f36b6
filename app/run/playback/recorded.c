#include "app/run/playback/playback.h"

#include "app/files/foreign/foreign.h"
#include "app/files/snapshot.h"
#include "render/frame/view.h"
#include "render/particles/particles.h"
#include "sim/gpu/particle_buffers.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

bool recorded_is_file(const char *path)
{
    return foreign_is_pattern(path) || foreign_format(path) != NULL;
}

bool recorded_is_alike(const char *one, const char *two)
{
    return foreign_format(one) == foreign_format(two);
}

/* ---- contents of the file ---- */

static void tell_lacks(const char *path, const SnapshotStep *step, Notes *notes)
{
    char words[256] = "";
#define X(name, source)                                                                                      \
    if (snapshot_step_misses(step, name))                                                                    \
        snprintf(words + strlen(words), sizeof words - strlen(words), "%s%s", *words ? ", " : "", name);
    SNAPSHOT_SOURCES(X)
#undef X
    if (*words)
        notes_add(notes, "%.160s: has no %s; what follows from that cannot be shown%s", path, words,
                  snapshot_step_misses(step, "density") ? ", and particles have the volume of fluid at rest"
                                                        : "");
}

static bool look_at_first(Recorded *recorded, Notes *notes, Error *error)
{
    SnapshotStep step;
    if (!snapshot_read_for_display(recorded->reader, 0, &step, error))
        return false;
    recorded->attributes = snapshot_attributes(&step);
    recorded->first = step.time;
    tell_lacks(recorded->path, &step, notes);
    snapshot_step_free(&step);
    return true;
}

/* ---- the file ---- */

static bool no_step(const SnapshotReader *reader, const char *path, Error *error)
{
    char words[256];
    const bool gap = snapshot_gap(reader, words);
    return error_set(error, "%s: %s; shown is what slosh run has written whole, from Step#0 on", path,
                     gap ? words : "has no whole step");
}

static void tell_gap(const SnapshotReader *reader, const char *path, Notes *notes)
{
    char words[256];
    if (snapshot_gap(reader, words))
        notes_add(notes, "%.100s: %s; only the %zu before it are shown", path, words,
                  snapshot_count_steps(reader));
}

static bool count(Recorded *recorded, Error *error)
{
    recorded->steps = snapshot_count_steps(recorded->reader);
    return recorded->steps > 0 &&
           snapshot_read_time(recorded->reader, recorded->steps - 1, &recorded->last, error);
}

static bool sets_views(const SceneSettings *settings)
{
    bool sets = false;
    for (int i = 0; settings && i < settings->count; i++)
        sets |= strncmp(settings->set[i], "views", strlen("views")) == 0;
    return sets;
}

/* Removes views beside the scene: nothing is simulated beside a recorded run, and files shown beside the
   run when it was recorded are not part of the file. */
static void drop_beside(Recorded *recorded, const SceneSettings *settings, Notes *notes)
{
    const bool said = sets_views(settings);
    for (int i = 0; i < recorded->scene.view_count; i++) {
        ViewDef *view = &recorded->scene.views[i];
        if (view->set || (view->file && !said))
            notes_add(
                notes, "%.200s: views[%d].%s is left out: %s", recorded->path, i, view->set ? "set" : "file",
                view->set ? "nothing is simulated beside a recorded run"
                          : "what stood beside this run is another file; --set 'views=[{}, {file: ...}]'");
        if (!said)
            view->file = NULL;
        view->set = NULL;
    }
}

static bool sets_color(const SceneSettings *settings)
{
    bool sets = sets_views(settings);
    for (int i = 0; settings && i < settings->count; i++)
        sets |= strncmp(settings->set[i], "view.color_by=", strlen("view.color_by=")) == 0;
    return sets;
}

static bool understand(Recorded *recorded, const SceneSettings *settings, Notes *notes, Error *error)
{
    if (snapshot_count_steps(recorded->reader) == 0)
        return no_step(recorded->reader, recorded->path, error);
    if (!recorded_scene(recorded->reader, recorded->path, recorded->foreign, settings, &recorded->numbers,
                        &recorded->scene, notes, error))
        return false;
    drop_beside(recorded, settings, notes);
    recorded->flaws = snapshot_flaws(recorded->reader, true);
    recorded->flaws.shown = true;
    tell_gap(recorded->reader, recorded->path, notes);
    if (!count(recorded, error) || !look_at_first(recorded, notes, error))
        return false;
    if (recorded->foreign && !sets_color(settings)) /* the default colour may be missing in the file */
        recorded_adapt(recorded, &recorded->scene.view, notes);
    return true;
}

bool recorded_open(const char *path, const SceneSettings *settings, Recorded *out, Notes *notes, Error *error)
{
    SnapshotAssumptions assume;
    Notes own = {.count = 0}; /* reading the scene begins the notes anew */
    *out = (Recorded){.foreign = snapshot_is_foreign(path)};
    if (out->foreign && !recorded_assumptions(path, settings, &assume, error))
        return false;
    out->reader = out->foreign ? snapshot_open_foreign(path, &assume, &own, error)
                               : snapshot_open_for_display(path, error);
    if (!out->reader)
        return false;
    snprintf(out->path, sizeof out->path, "%s", path);
    if (understand(out, settings, notes, error)) {
        for (int i = 0; i < own.count; i++)
            notes_add(notes, "%s", own.line[i]);
        return true;
    }
    recorded_close(out);
    return false;
}

void recorded_close(Recorded *recorded)
{
    snapshot_reader_close(recorded->reader);
    recorded->reader = NULL;
}

bool recorded_follow(Recorded *recorded, Error *error)
{
    return snapshot_refresh(recorded->reader, error) && count(recorded, error);
}

/* ---- times ---- */

bool recorded_time(Recorded *recorded, size_t index, double *time, Error *error)
{
    return snapshot_read_time(recorded->reader, index, time, error);
}

/* Rounding error of a time, s. */
static double slack(double time)
{
    return 1e-9 * fmax(fabs(time), 1);
}

bool recorded_find_after(Recorded *recorded, double time, size_t *index, Error *error)
{
    double at;
    if (!recorded_find(recorded, time, index, error) || !recorded_time(recorded, *index, &at, error))
        return false;
    *index += at < time - slack(time) && *index + 1 < recorded->steps;
    return true;
}

bool recorded_find(Recorded *recorded, double time, size_t *index, Error *error)
{
    const double latest = time + slack(time);
    size_t low = 0, high = recorded->steps; /* the step is in low .. high - 1 */
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        double at;
        if (!recorded_time(recorded, middle, &at, error))
            return false;
        if (at <= latest)
            low = middle;
        else
            high = middle;
    }
    *index = low;
    return true;
}

/* ---- states ---- */

static void describe(const Recorded *recorded, const SnapshotStep *step, ParticleBuffers *out)
{
    *out = (ParticleBuffers){.count = step->count,
                             .spacing = recorded->numbers.spacing,
                             .support_radius = recorded->numbers.support_radius,
                             .box = step->box,
                             .time = step->time,
                             .step = step->step};
    snapshot_floating(step, out->floating);
    memcpy(out->box_size, recorded->numbers.box_size, sizeof out->box_size);
    memcpy(out->gravity, step->gravity, sizeof out->gravity);
}

/* Fails if the step lacks attributes of the first step: they would be 0. */
static bool is_like_first(const Recorded *recorded, const SnapshotStep *step, size_t index, Error *error)
{
    return (recorded->attributes & ~snapshot_attributes(step)) == 0 ||
           error_set(error, "%s: Step#%zu lacks what Step#0 has", recorded->path, index);
}

static bool take(Recorded *recorded, size_t index, unsigned attributes, SnapshotStep *step, StateCopy *out,
                 Error *error)
{
    if (!is_like_first(recorded, step, index, error))
        return false;
    if (!snapshot_validate(&recorded->flaws, index, step) ||
        !state_copy_reserve(out, step->count, attributes & recorded->attributes))
        return error_set(error, "%s: out of memory for %zu particles", recorded->path, step->count);
    describe(recorded, step, &out->state);
    snapshot_arrays(&recorded->numbers, step, SNAPSHOT_VOLUME, &out->arrays);
    return true;
}

bool recorded_read(Recorded *recorded, size_t index, unsigned attributes, StateCopy *out, Error *error)
{
    SnapshotStep step;
    if (!snapshot_read_for_display(recorded->reader, index, &step, error))
        return false;
    const bool taken = take(recorded, index, attributes, &step, out, error);
    snapshot_step_free(&step);
    return taken;
}

/* Checks which views a recorded file has enough attributes for. */

/* ---- attributes (PARTICLE_*) needed by a part of a view but missing in the file ---- */

/* If the file has times of birth, ids are not needed to find them. */
static unsigned lacks_scalar(const Recorded *recorded, Scalar scalar)
{
    const ParticleWants wants = {.scalars = SCALAR_BIT(scalar)};
    const unsigned needs = particle_wants_attributes(&wants);
    return needs & ~(recorded->attributes | (needs & PARTICLE_SCALAR(SCALAR_BORN) ? PARTICLE_ID : 0));
}

static unsigned lacks_color(const Recorded *recorded, const ViewDef *view)
{
    return strcmp(view->kind, "none") == 0 ? 0 : lacks_scalar(recorded, view_color_by(view));
}

/* Screen-door transparency needs ids. */
static unsigned lacks_opacity(const Recorded *recorded, const ViewDef *view)
{
    return view->opacity.by == 0 ? 0
                                 : lacks_scalar(recorded, scalar_of_curve(&view->opacity)) |
                                       (PARTICLE_SCALAR(SCALAR_ID) & ~recorded->attributes);
}

static unsigned lacks_size(const Recorded *recorded, const ViewDef *view)
{
    return view->size.by == 0 ? 0 : lacks_scalar(recorded, scalar_of_curve(&view->size));
}

static OverlayShow *show_of(const ViewDef *view, const OverlayKind *kind)
{
    return overlay_own_settings(view, kind);
}

static unsigned lacks_overlay(const Recorded *recorded, const ViewDef *view, const OverlayKind *kind)
{
    ParticleWants wants = {.scalars = 0};
    if (!show_of(view, kind)->show)
        return 0;
    kind->wants(view, &wants);
    return particle_wants_attributes(&wants) & ~recorded->attributes;
}

/* ---- in words ---- */

static void name_first(unsigned attributes, char words[64])
{
    int scalar = 0;
    while (scalar < SCALAR_STATE_COUNT && !(attributes & PARTICLE_SCALAR(scalar)))
        scalar++;
    snprintf(words, 64, "%s",
             attributes & PARTICLE_VELOCITY                            ? "velocities"
             : attributes & PARTICLE_SCALAR(SCALAR_BORN)               ? "times of birth (born)"
             : attributes & (PARTICLE_ID | PARTICLE_SCALAR(SCALAR_ID)) ? "ids"
             : scalar < SCALAR_STATE_COUNT                             ? scalar_name((Scalar)scalar)
                                                                       : "fluids");
}

static bool needs(const Recorded *recorded, const char *key, unsigned lacks, Error *error)
{
    char words[64];
    name_first(lacks, words);
    return error_set(error, "%s: view.%s needs %s, which the file has not", recorded->path, key, words);
}

static bool no_color(const Recorded *recorded, Scalar scalar, Error *error)
{
    char known[512] = "";
    for (int s = 0; s < SCALAR_COUNT; s++)
        if (!lacks_scalar(recorded, (Scalar)s))
            snprintf(known + strlen(known), sizeof known - strlen(known), "%s%s", *known ? ", " : "",
                     scalar_name((Scalar)s));
    return error_set(error, "%s: has no %s to colour by; view.color_by may be %s", recorded->path,
                     scalar_name(scalar), known);
}

/* ---- whole view ---- */

bool recorded_has(const Recorded *recorded, const ViewDef *view, Error *error)
{
    char key[64];
    unsigned lacks;
    if (lacks_color(recorded, view))
        return no_color(recorded, view_color_by(view), error);
    if ((lacks = lacks_opacity(recorded, view)))
        return needs(recorded, "opacity.by", lacks, error);
    if ((lacks = lacks_size(recorded, view)))
        return needs(recorded, "size.by", lacks, error);
    for (int i = 0; overlay_list[i]; i++)
        if ((lacks = lacks_overlay(recorded, view, overlay_list[i]))) {
            snprintf(key, sizeof key, "%s.show", overlay_list[i]->name);
            return needs(recorded, key, lacks, error);
        }
    return true;
}

void recorded_adapt(const Recorded *recorded, ViewDef *view, Notes *notes)
{
    Error why = {{0}};
    while (!recorded_has(recorded, view, &why)) {
        const bool color = lacks_color(recorded, view);
        notes_add(notes, "%.300s; %s", why.message, color ? "coloured by fluid" : "left out");
        if (color)
            view->color_by = SCALAR_FLUID;
        else if (lacks_opacity(recorded, view))
            view->opacity.by = 0;
        else if (lacks_size(recorded, view))
            view->size.by = 0;
        else
            for (int i = 0; overlay_list[i]; i++)
                if (lacks_overlay(recorded, view, overlay_list[i]))
                    show_of(view, overlay_list[i])->show = false;
    }
}
