#include "app/base/program.h"
#include "app/run/session.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

/* True for settings without effect on the bits: drawing, and the count of processors. */
static bool is_allowed(const char *setting)
{
    static const char *const keys[] = {"view.",  "view=",           "touch.",
                                       "touch=", "solver.threads=", "solver.simd="};
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        if (strncmp(setting, keys[i], strlen(keys[i])) == 0)
            return true;
    return false;
}

bool recording_play_allows(const char *path, const SceneSettings *more, Error *error)
{
    static const char OWN[] = "the session has its own; how it is drawn (view.*) may change";
    if (more->particles > 0)
        return error_set(error, "--particles makes no sense for %s: %s", path, OWN);
    for (int i = 0; i < more->count; i++)
        if (!is_allowed(more->set[i]))
            return error_set(error, "%s%.100s makes no sense for %.300s: %s", more->said[i] ? "" : "--set ",
                             more->said[i] ? more->said[i] : more->set[i], path, OWN);
    return true;
}

bool recording_play_scene(const Recording *recording, const SceneSettings *more, ScenePurpose purpose,
                          Scene *scene, Notes *notes, Error *error)
{
    SceneSettings settings = recording->settings;
    settings.purpose = purpose;
    for (int i = 0; more && i < more->count; i++) {
        if (settings.count == SCENE_SETTINGS_MAX)
            return error_set(error, "more than %d settings; leave --threads out", SCENE_SETTINGS_MAX);
        settings.said[settings.count] = more->said[i];
        settings.set[settings.count++] = more->set[i];
    }
    return scene_parse(recording->path, recording->text, recording->size, &settings, scene, notes, error);
}

/* True if the session moved to a GPU backend. */
static bool moves_to_gpu(const Recording *recording)
{
    bool moves = false;
    for (size_t i = 0; i < recording->count; i++)
        moves |= sim_command_needs_gpu(&recording->commands[i]);
    return moves;
}

int recording_play_open(const RecordingPlay *play, const SceneSettings *more, int gpu, bool draws,
                        Session *session, Error *error)
{
    Error why = {""};
    *session = (Session){.began_ms = wall_ms()};
    const bool loaded =
        recording_play_scene(play->recording, more, SCENE_FOR_ONE, &session->run.scene, NULL, &why);
    const int code =
        loaded ? session_start(session, gpu, draws || moves_to_gpu(play->recording), &why) : EXIT_USAGE;
    if (code != 0)
        error_set(error, "%.300s: its scene: %.600s", play->path, why.message);
    return code;
}

bool recording_play_apply(RecordingPlay *play, Session *session, Error *error)
{
    const Recording *recording = play->recording;
    Error why = {""};
    for (const SimCommand *command;
         (command = recording_due(recording, &play->next, session->run.info.step)) != NULL;)
        if (!run_apply(&session->run, command, &why))
            return error_set(error, "%.300s:%zu: %.600s", play->path,
                             recording_line(recording, play->next - 1), why.message);
    return true;
}

bool recording_play_ended(const RecordingPlay *play, const Session *session)
{
    return play->next == play->recording->count && session->run.info.step >= play->recording->steps;
}

bool recording_play_broke(const RecordingPlay *play, const Session *session)
{
    const Recording *recording = play->recording;
    return !recording->cut && play->next == recording->count && session->run.info.step == recording->steps;
}

bool recording_play_same(const RecordingPlay *play, uint64_t hash)
{
    return !play->recording->cut && hash == play->recording->hash;
}

void recording_play_warn_version(const char *path, const Recording *recording)
{
    if (strcmp(recording->program, SLOSH_VERSION) != 0)
        fprintf(stderr, "%s: recorded by slosh %s; this is %s, whose bits may differ\n", path,
                recording->program, SLOSH_VERSION);
}

static void advise(const WorldDef *def)
{
    if (strcmp(def->backend, "compute") == 0 && !def->reproducible)
        fprintf(stderr,
                "backend compute gives the same bits only with solver.reproducible: true in the scene\n");
}

int recording_play_report(const RecordingPlay *play, const Session *session, bool ended, uint64_t hash,
                          bool quiet)
{
    const Recording *recording = play->recording;
    const uint64_t step = session->run.info.step;
    if (!ended) {
        fprintf(stderr, "stopped at step %" PRIu64 " of %" PRIu64 "; nothing was compared\n", step,
                recording->steps);
        return EXIT_INTERRUPTED;
    }
    if (recording->cut) {
        fprintf(stderr,
                "%s:%zu: the recording was cut here, its last line 'end STEPS HASH' is missing; %" PRIu64
                " step%s replayed, hash %016" PRIx64 ", and nothing is proven\n",
                play->path, recording_line(recording, recording->count), step, step == 1 ? " was" : "s were",
                hash);
        return EXIT_FAILED;
    }
    if (!recording_play_same(play, hash)) {
        fprintf(stderr,
                "different after %" PRIu64 " steps: hash %016" PRIx64 ", and %016" PRIx64 " was recorded%s\n",
                step, hash, recording->hash,
                strcmp(recording->program, SLOSH_VERSION) == 0 ? "" : " by another version");
        advise(&session->run.scene.world);
        return EXIT_FAILED;
    }
    if (!quiet)
        fprintf(stderr, "the same bits: %" PRIu64 " steps, hash %016" PRIx64 "\n", step, hash);
    return 0;
}
