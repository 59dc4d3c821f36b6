#include "app/cmd.h"
#include "app/interrupt.h"
#include "app/json_file.h"
#include "app/output.h"
#include "app/progress.h"
#include "app/recording.h"
#include "sim/world.h"

#include <stdio.h>
#include <string.h>

/* A recording on its way. */
typedef struct Replay {
    Recording recording;
    Scene scene;
    World *world;
    size_t done; /* commands */
    uint64_t step, hash;
} Replay;

static bool replay_open(Replay *replay, const Args *args, Error *error)
{
    const char *path = args->scenes[0];
    if (!recording_read(path, &replay->recording, error))
        return false;
    Recording *recording = &replay->recording;
    SceneSettings settings = recording->settings;
    for (int i = 0; i < args->settings.count && settings.count < SCENE_SETTINGS_MAX; i++)
        settings.set[settings.count++] = args->settings.set[i];
    if (!scene_parse(recording->path, recording->text, recording->size, &settings, &replay->scene, NULL,
                     error))
        return false;
    replay->world = world_create(&replay->scene.world, error);
    if (replay->world && strcmp(recording->program, SLOSH_VERSION) != 0 && !args->quiet)
        fprintf(stderr, "%s: recorded by slosh %s, replayed by %s: the bits may differ\n", path,
                recording->program, SLOSH_VERSION);
    return replay->world != NULL;
}

static void replay_close(Replay *replay)
{
    world_destroy(replay->world);
    recording_destroy(&replay->recording);
}

/* The commands of the present step. */
static bool obey(Replay *replay, Error *error)
{
    const Recording *recording = &replay->recording;
    while (replay->done < recording->count && recording->commands[replay->done].step == replay->step) {
        if (!sim_command_apply(&recording->commands[replay->done++], replay->world, &replay->scene, error))
            return false;
    }
    return true;
}

static bool simulate(Replay *replay, uint64_t steps, Progress *progress, Error *error)
{
    while (replay->step < steps && !interrupted()) {
        WorldInfo info;
        if (!obey(replay, error) || !world_substep(replay->world, NULL, error))
            return false;
        world_info(replay->world, &info);
        replay->step = info.step;
        progress_update(progress, (double)info.step / (double)steps);
    }
    replay->hash = world_hash(replay->world);
    return true;
}

static bool write_json(const Replay *replay, const Args *args, bool same, Error *error)
{
    char hash[32], recorded[32];
    snprintf(hash, sizeof hash, "0x%016llx", (unsigned long long)replay->hash);
    snprintf(recorded, sizeof recorded, "0x%016llx", (unsigned long long)replay->recording.hash);
    json_t *json = json_pack("{s:s, s:s, s:s, s:I, s:I, s:s, s:s, s:b}", "command", "replay", "recording",
                             args->scenes[0], "scene", replay->recording.path, "steps",
                             (json_int_t)replay->step, "commands", (json_int_t)replay->done, "hash", hash,
                             "recorded_hash", recorded, "same", same);
    const bool written = json_file_write(json, args->json, error);
    json_decref(json);
    return written;
}

static int compare(const Replay *replay, const Args *args, Error *error)
{
    const Recording *recording = &replay->recording;
    const char *path = args->scenes[0];
    const bool same =
        recording->complete && replay->step == recording->steps && replay->hash == recording->hash;
    if (!recording->complete)
        fprintf(stderr, "%s: the recording was cut off; %llu steps were replayed, to compare with nothing\n",
                path, (unsigned long long)replay->step);
    else if (!same)
        fprintf(stderr, "%s: other bits: hash 0x%016llx after %llu steps, recorded 0x%016llx after %llu\n",
                path, (unsigned long long)replay->hash, (unsigned long long)replay->step,
                (unsigned long long)recording->hash, (unsigned long long)recording->steps);
    else if (!args->quiet)
        printf("%s: the same bits: %llu steps, %zu commands, hash 0x%016llx\n", path,
               (unsigned long long)replay->step, replay->done, (unsigned long long)replay->hash);
    if (args->json && !write_json(replay, args, same, error))
        fprintf(stderr, "%s\n", error->message);
    else if (same)
        return 0;
    return EXIT_FAILED;
}

/* Without an end: up to the last command. */
static uint64_t steps_of(const Recording *recording)
{
    return recording->complete    ? recording->steps
           : recording->count > 0 ? recording->commands[recording->count - 1].step
                                  : 0;
}

int cmd_replay(const Args *args)
{
    static Replay replay;
    Progress progress;
    Error error = {{0}};
    int code = EXIT_USAGE;
    interrupt_install();
    if (!replay_open(&replay, args, &error)) {
        fprintf(stderr, "%s\n", error.message);
    } else if (args->json && !output_check(args->json, &error)) {
        fprintf(stderr, "%s\n", error.message);
        code = EXIT_FAILED;
    } else {
        progress_begin(&progress, stderr, "replay", args->quiet);
        const bool ok = simulate(&replay, steps_of(&replay.recording), &progress, &error);
        progress_end(&progress);
        if (!ok)
            fprintf(stderr, "%s: step %llu: %s\n", args->scenes[0], (unsigned long long)replay.step,
                    error.message);
        code = !ok ? EXIT_FAILED : interrupted() ? EXIT_INTERRUPTED : compare(&replay, args, &error);
    }
    replay_close(&replay);
    return code;
}
