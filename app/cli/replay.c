#include "app/base/file.h"
#include "app/base/program.h"
#include "app/cli/cli_private.h"
#include "app/cli/option_rows.h"
#include "app/run/session.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

/* A recording being simulated. */
typedef struct Replay {
    const Args *args;
    const char *path;
    Recording recording;
    RecordingPlay play;
    Session session;
    SnapshotSeries series;
    uint64_t hash; /* at the end */
    bool ended;    /* false: stopped early by a signal */
    bool broke;    /* the simulation blew up at the recording's end */
} Replay;

static int fail(int code, const Error *error)
{
    fprintf(stderr, "%s\n", error->message);
    return code;
}

static int fail_run(const Args *args, int code, const Error *error)
{
    if (code == EXIT_FAILED)
        failure_json_write(failure_json("replay", "recording", args->scenes[0], args->output, error),
                           args->json);
    return fail(code, error);
}

/* Returns 0, or the exit code with the reason. */
static int simulate(Replay *replay, Progress *progress, Error *error)
{
    Session *session = &replay->session;
    for (;;) {
        if (!recording_play_apply(&replay->play, session, error))
            return EXIT_USAGE;
        if (!snapshot_series_add(&replay->series, session, error))
            return EXIT_FAILED;
        replay->ended = recording_play_ended(&replay->play, session);
        if (replay->ended || interrupted())
            return 0;
        if (!session_substep(session, error)) {
            replay->broke = replay->ended = recording_play_broke(&replay->play, session);
            return replay->broke ? 0 : EXIT_FAILED;
        }
        progress_update(progress, (double)session->run.info.step / (double)replay->recording.steps);
    }
}

static bool same_bits(const Replay *replay)
{
    return replay->ended && recording_play_same(&replay->play, replay->hash);
}

static bool write_json(const Replay *replay, Error *error)
{
    const Session *session = &replay->session;
    const WorldInfo *info = &session->run.info;
    const WorldDef *def = &session->run.scene.world;
    char hash[17], recorded[17];
    if (!replay->args->json)
        return true;
    snprintf(hash, sizeof hash, "%016" PRIx64, replay->hash);
    snprintf(recorded, sizeof recorded, "%016" PRIx64, replay->recording.hash);
    json_t *json = json_pack(
        "{s:s, s:s, s:s, s:s, s:s, s:s, s:i, s:I, s:I, s:I, s:f, s:f, s:s, s:s*, s:b, s:b}", "command",
        "replay", "recording", replay->path, "program", replay->recording.program, "scene",
        session->run.scene.path, "backend", def->backend, "method", def->method, "threads", info->threads,
        "particles", (json_int_t)info->count, "steps", (json_int_t)info->step, "commands",
        (json_int_t)replay->play.next, "simulated_seconds", info->time, "wall_seconds",
        (wall_ms() - session->began_ms) / 1000, "hash", hash, "recorded_hash",
        replay->recording.cut ? NULL : recorded, "same", same_bits(replay), "stopped", !replay->ended);
    const bool written = json_file_write(json, replay->args->json, error);
    json_decref(json);
    return written;
}

static int finish(Replay *replay, Error *error)
{
    replay->hash = world_hash(replay->session.run.world);
    if (replay->series.file && !replay->args->quiet)
        fprintf(stderr, "%s: %zu snapshot%s\n", replay->args->output, snapshot_steps(replay->series.file),
                plural(snapshot_steps(replay->series.file)));
    if (replay->broke)
        fprintf(stderr, "%s\n", error->message);
    const int code = recording_play_report(&replay->play, &replay->session, replay->ended, replay->hash,
                                           replay->args->quiet);
    return write_json(replay, error) ? code : fail(EXIT_FAILED, error);
}

/* Warns of changes that the snapshots lack, as their file has the initial scene. */
static void tell_what_lacks(const Replay *replay)
{
    static const char *const words[] = {"what was done to solids", "the box's new size",
                                        "when poured fluid came"};
    bool lacks[3] = {false};
    int differences = 0;
    for (size_t i = 0; i < replay->recording.count; i++) {
        const SimCommand *command = &replay->recording.commands[i];
        lacks[0] |= command->kind == SIM_SOLID;
        lacks[1] |= command->kind == SIM_SIZE;
        lacks[2] |= command->kind == SIM_TOUCH && finger_fluid(&command->finger) >= 0;
    }
    for (int k = 0; k < 3; k++) {
        if (!lacks[k])
            continue;
        if (differences == 0)
            fprintf(stderr, "%s: warning: only the recording has ", replay->args->output);
        fprintf(stderr, "%s%s", differences++ > 0 ? ", " : "", words[k]);
    }
    if (differences > 0)
        fputc('\n', stderr);
}

static int run(Replay *replay, Error *error)
{
    const Args *args = replay->args;
    Progress progress;
    if (args->json && !json_file_check(args->json, error))
        return fail(EXIT_FAILED, error);
    if (args->output) {
        SnapshotWriter *file = snapshot_create(args->output, &replay->session.run.scene, error);
        if (!file)
            return fail_run(args, EXIT_FAILED, error);
        replay->series = (SnapshotSeries){.file = file, .every = options_of_run(args)->every};
        tell_what_lacks(replay);
    }
    progress_begin(&progress, stderr, "replay", args->quiet);
    const int code = simulate(replay, &progress, error);
    progress_end(&progress);
    if (code == 0)
        return finish(replay, error);
    fail_run(args, code, error);
    snapshot_series_report_left(replay->series.file, args->output);
    return code;
}

static int open_recording(Replay *replay, Error *error)
{
    const Args *args = replay->args;
    if ((args->output && !snapshot_series_check_name(args->output, error)) ||
        !recording_read(replay->path, &replay->recording, error))
        return EXIT_USAGE;
    recording_play_warn_version(replay->path, &replay->recording);
    replay->play = (RecordingPlay){.path = replay->path, .recording = &replay->recording};
    return recording_play_open(&replay->play, &args->settings, args->gpu, false, &replay->session, error);
}

static int run_command(const Args *args)
{
    Replay replay = {.args = args, .path = args->scenes[0]};
    Error error = {{0}};
    interrupt_install();
    int code = open_recording(&replay, &error);
    code = code == 0 ? run(&replay, &error) : fail_run(args, code, &error);
    snapshot_close(replay.series.file);
    session_close(&replay.session);
    recording_destroy(&replay.recording);
    return code;
}

/* clang-format off */
static const OptionRow options[] = {
    ROW_OUTPUT_FILE,
    ROW_EVERY(RunOptions),
    ROWS_PROCESSOR, ROW_GPU, ROW_SHADERS, ROW_DEVICE_REFUSED("all that moved the box is in the recorded session"),
    ROW_JSON, ROWS_END
};
/* clang-format on */

const Command command_replay = {
    .name = "replay",
    .usage = "FILE [OPTIONS]",
    .help = "a recorded session again, and whether it gives the same bits",
    .takes = "recording",
    .takes_min = 1,
    .takes_max = 1,
    .own_size = sizeof(RunOptions),
    .argument_files = files_recording,
    .options = options,
    .run = run_command,
};
