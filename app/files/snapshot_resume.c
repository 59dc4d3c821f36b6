/* Resumes a run from the end of its file. */
#include "app/files/snapshot_private.h"
#include "app/scene/scene.h"
#include "sim/step/method.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A line of settings, "key = value", within a text. */
typedef struct SettingsLine {
    const char *text;
    int size;
} SettingsLine;

/* True if the line's key changes no bit of a run: by the key's row, or, for a removed key, by the row of the
   mapping above. Values of presets have lines of their own. */
static bool is_idle(SettingsLine line)
{
    char path[128];
    snprintf(path, sizeof path, "%.*s", (int)strcspn(line.text, " "), line.text);
    const Key *key = scene_key_find(path);
    for (char *dot; !key && (dot = strrchr(path, '.'));) {
        *dot = '\0';
        key = scene_key_find(path);
    }
    return key && key->flags & KEY_IDLE;
}

/* Finds the next relevant line of `*text`; false at the end. */
static bool next_line(const char **text, SettingsLine *line)
{
    while (**text) {
        *line = (SettingsLine){*text, (int)strcspn(*text, "\n")};
        *text += line->size + ((*text)[line->size] == '\n');
        if (!is_idle(*line))
            return true;
    }
    *line = (SettingsLine){"nothing more", (int)strlen("nothing more")};
    return false;
}

/* Writes the line; of a long line the key and the text around `at`. */
static void line_words(SettingsLine line, int at, char words[256])
{
    enum { WHOLE = 160, BEFORE = 50, SHOWN = 110 };
    const int key = (int)strcspn(line.text, "=") + 1, from = at - BEFORE;
    if (line.size <= WHOLE || from <= key)
        snprintf(words, 256, "%.*s%s", line.size < WHOLE ? line.size : WHOLE, line.text,
                 line.size > WHOLE ? "..." : "");
    else
        snprintf(words, 256, "%.*s ...%.*s%s", key < 120 ? key : 120, line.text,
                 line.size - from < SHOWN ? line.size - from : SHOWN, line.text + from,
                 line.size - from > SHOWN ? "..." : "");
}

static bool fail_at(const char *path, SettingsLine was, SettingsLine is, Error *error)
{
    char before[256], now[256];
    int at = 0;
    while (at < was.size && at < is.size && was.text[at] == is.text[at])
        at++;
    line_words(was, at, before);
    line_words(is, at, now);
    return error_set(
        error,
        "%.300s: was made with '%s', and this is '%s'; resume with the same scene and settings, or "
        "name another file",
        path, before, now);
}

static bool same_settings(const char *path, const char *file, const char *scene, Error *error)
{
    SettingsLine was, is;
    for (;;) {
        const bool more = next_line(&file, &was), also = next_line(&scene, &is);
        if (!more && !also)
            return true;
        if (was.size != is.size || memcmp(was.text, is.text, (size_t)is.size) != 0)
            return fail_at(path, was, is, error);
    }
}

/* Checks for stray steps, as a new step could have the same name. */
static bool check_steps(const SnapshotReader *reader, const char *path, Error *error)
{
    char words[256];
    return !snapshot_gap(reader, words) ||
           error_set(
               error,
               "%.300s: %s; give the steps names without a gap, remove those behind it, or name another file",
               path, words);
}

static bool check_scene(const SnapshotReader *reader, const char *path, const Scene *scene, Error *error)
{
    char *file = snapshot_root_text(reader, SNAPSHOT_SETTINGS), *now = scene_print_text(scene);
    bool same = false;
    if (!file)
        error_set(error, "%s: was made by a slosh that could not resume; name another file", path);
    else
        same = now ? same_settings(path, file, now, error) : error_set(error, "%s: out of memory", path);
    free(file);
    free(now);
    return same;
}

static bool check_hand(const SnapshotReader *reader, const char *path, const char *hand, Error *error)
{
    char *noted = snapshot_root_text(reader, SNAPSHOT_MOTION_SOURCE);
    const char *was = noted ? noted : "";
    const bool same = strcmp(was, hand) == 0;
    if (!same && !*hand)
        error_set(error, "%s: --device moved its box; resume with the same one, or name another file", path);
    else if (!same && !*was)
        error_set(error, "%s: no --device moved its box; resume without one, or name another file", path);
    else if (!same)
        error_set(error,
                  "%s: another recording, mapping or camera moved its box; resume with the same ones, or "
                  "name another file",
                  path);
    free(noted);
    return same;
}

static bool state_of(const SnapshotStep *step, const WorldDef *def, WorldState *state)
{
    if (!world_state_reserve(state, def, step->count))
        return false;
    state->numbers = step->restart;
    const ParticleColumns *p = &state->particles;
    float *const to[] = {p->x, p->y, p->z, p->vx, p->vy, p->vz, p->compression};
    const float *const from[] = {step->position[0], step->position[1], step->position[2], step->velocity[0],
                                 step->velocity[1], step->velocity[2], step->compression};
    for (size_t k = 0; k < sizeof to / sizeof *to; k++)
        if (to[k] && step->count > 0)
            memcpy(to[k], from[k], step->count * sizeof(float));
    for (int k = 0; k < step->own_count && step->count > 0; k++)
        memcpy(p->own[step->own[k].place], step->own[k].values, step->count * sizeof(float));
    for (size_t i = 0; i < step->count; i++) {
        p->fluid[i] = (uint8_t)step->fluid[i];
        p->id[i] = (ParticleId)step->id[i];
    }
    return !step->born || births_gather(&state->births, p->id, step->born, step->count);
}

static bool read_last(SnapshotReader *reader, const char *path, const WorldDef *def, WorldState *state,
                      Error *error)
{
    SnapshotStep step;
    const ColumnRows saved = columns_saved(def);
    const size_t steps = snapshot_count_steps(reader);
    if (steps == 0)
        return error_set(error, "%s: has no whole step to resume from; remove it to start anew", path);
    if (!snapshot_read_step(reader, steps - 1, &step, error) ||
        !snapshot_read_method_columns(reader, steps - 1, &saved, &step, error))
        return false;
    const bool known = step.restart.version != 0;
    const bool read = known && state_of(&step, def, state);
    snapshot_step_free(&step);
    return read || error_set(error,
                             known ? "%s: out of memory"
                                   : "%s: was made by a slosh that could not resume; name another file",
                             path);
}

/* Returns the count of complete steps, or 0 with the reason. */
static size_t read_end(const char *path, const Scene *scene, const char *hand, WorldState *state,
                       Error *error)
{
    SnapshotReader *reader = snapshot_open(path, error);
    if (!reader)
        return 0;
    const bool good = check_steps(reader, path, error) && check_scene(reader, path, scene, error) &&
                      check_hand(reader, path, hand, error) &&
                      read_last(reader, path, &scene->world, state, error);
    const size_t steps = snapshot_count_steps(reader);
    snapshot_reader_close(reader);
    return good ? steps : 0;
}

SnapshotWriter *snapshot_resume_parallel(const char *path, const Scene *scene, const char *hand,
                                         const SnapshotParallel *share, WorldState *state, bool *busy,
                                         Error *error)
{
    OutputLock lock = {.state = OUTPUT_UNLOCKED};
    const bool first = !share || share->first;
    size_t steps = 0;
    *busy = first && !output_lock(&lock, path, error);
    if (first && !*busy)
        steps = read_end(path, scene, hand, state, error);
    if (share) {
        share->tell(&steps, sizeof steps);
        share->tell(busy, sizeof *busy);
        share->agree(!first || steps > 0, error);
    }
    SnapshotWriter *snapshot =
        steps > 0 ? snapshot_continue(path, &scene->world, steps, &lock, share, error) : NULL;
    output_unlock(&lock);
    return snapshot;
}

SnapshotWriter *snapshot_resume(const char *path, const Scene *scene, const char *hand, WorldState *state,
                                bool *busy, Error *error)
{
    return snapshot_resume_parallel(path, scene, hand, NULL, state, busy, error);
}

bool snapshot_load(const char *path, const Scene *scene, WorldState *state, Error *error)
{
    return read_end(path, scene, "", state, error) > 0;
}

static bool first_of(const SnapshotStep *step, SnapshotFirst *first)
{
    first->position = malloc((step->count + 1) * 3 * sizeof *first->position);
    first->fluid = malloc(step->count + 1);
    for (size_t i = 0; first->position && first->fluid && i < step->count; i++) {
        for (size_t k = 0; k < 3; k++)
            first->position[3 * i + k] = step->position[k][i];
        first->fluid[i] = (uint8_t)step->fluid[i];
    }
    first->initial = (InitialState){.count = step->count, .position = first->position, .fluid = first->fluid};
    return first->position && first->fluid;
}

bool snapshot_first(const char *path, SnapshotFirst *first, Error *error)
{
    SnapshotStep step;
    SnapshotReader *reader = snapshot_open(path, error);
    *first = (SnapshotFirst){.position = NULL};
    if (!reader)
        return false;
    bool ok = snapshot_count_steps(reader) > 0 ||
              error_set(error, "%s: has no whole step to resume from; remove it to start anew", path);
    ok = ok && snapshot_read_step(reader, 0, &step, error);
    snapshot_reader_close(reader);
    if (!ok)
        return false;
    ok = first_of(&step, first) || error_set(error, "%s: out of memory", path);
    snapshot_step_free(&step);
    if (!ok)
        snapshot_first_free(first);
    return ok;
}

void snapshot_first_free(SnapshotFirst *first)
{
    free(first->position);
    free(first->fluid);
    *first = (SnapshotFirst){.position = NULL};
}
