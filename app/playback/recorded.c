#include "app/playback/recorded.h"

#include "app/files/snapshot.h"
#include "app/playback/recorded_scene.h"
#include "sim/gl/particle_buffers.h"

#include <math.h>
#include <string.h>
#include <strings.h>

bool recorded_is_file(const char *path)
{
    static const char ending[] = ".h5part";
    const size_t length = strlen(path), end = strlen(ending);
    return length > end && strcasecmp(path + length - end, ending) == 0;
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
        if (*view->set || (*view->file && !said))
            notes_add(
                notes, "%.200s: views[%d].%s is left out: %s", recorded->path, i, *view->set ? "set" : "file",
                *view->set ? "nothing is simulated beside a recorded run"
                           : "what stood beside this run is another file; --set 'views=[{}, {file: ...}]'");
        if (!said)
            *view->file = 0;
        *view->set = 0;
    }
}

static bool understand(Recorded *recorded, const SceneSettings *settings, Notes *notes, Error *error)
{
    if (snapshot_count_steps(recorded->reader) == 0)
        return no_step(recorded->reader, recorded->path, error);
    if (!recorded_scene(recorded->reader, recorded->path, settings, &recorded->numbers, &recorded->scene,
                        notes, error))
        return false;
    drop_beside(recorded, settings, notes);
    recorded->flaws = snapshot_flaws(recorded->reader, true);
    recorded->flaws.shown = true;
    tell_gap(recorded->reader, recorded->path, notes);
    return count(recorded, error) && look_at_first(recorded, notes, error);
}

bool recorded_open(const char *path, const SceneSettings *settings, Recorded *out, Notes *notes, Error *error)
{
    *out = (Recorded){.reader = snapshot_open_for_display(path, error)};
    if (!out->reader)
        return false;
    snprintf(out->path, sizeof out->path, "%s", path);
    if (understand(out, settings, notes, error))
        return true;
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

static bool take(Recorded *recorded, size_t index, unsigned attributes, SnapshotStep *step, Still *out,
                 Error *error)
{
    if (!is_like_first(recorded, step, index, error))
        return false;
    if (!snapshot_validate(&recorded->flaws, index, step) ||
        !still_reserve(out, step->count, attributes & recorded->attributes))
        return error_set(error, "%s: out of memory for %zu particles", recorded->path, step->count);
    describe(recorded, step, &out->state);
    snapshot_arrays(&recorded->numbers, step, SNAPSHOT_VOLUME, &out->arrays);
    return true;
}

bool recorded_read(Recorded *recorded, size_t index, unsigned attributes, Still *out, Error *error)
{
    SnapshotStep step;
    if (!snapshot_read_for_display(recorded->reader, index, &step, error))
        return false;
    const bool taken = take(recorded, index, attributes, &step, out, error);
    snapshot_step_free(&step);
    return taken;
}
