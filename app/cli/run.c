#include "app/base/file.h"
#include "app/base/program.h"
#include "app/bench/bench.h"
#include "app/cli/cli_private.h"
#include "app/cli/option_rows.h"
#include "app/files/forces_log.h"
#include "app/run/measure/measure.h"
#include "app/run/session.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

/* After trouble that smaller steps did not cure, keeps the world's last good state, for inspection. */
static void keep_last(const Session *session, SnapshotWriter *file)
{
    Error none = {{0}};
    if (session->run.scene.world.retries > 0 && session->run.info.time > snapshot_time(file))
        snapshot_append(file, session->run.world, &none);
}

/* Figures of the states with a snapshot. */
typedef struct RunProgress {
    CompressionTally compression;
    double step_seconds; /* wall time of the steps, without writing */
    ForcesLog forces;    /* of --forces */
    ProbeSeries probes;  /* of --probes */
    bool complete;       /* the resumed file already reaches --time */
} RunProgress;

static bool step(Session *session, RunProgress *look, Error *error)
{
    const double begin = wall_ms();
    bool ok = true;
    do
        ok = session_substep(session, error) && probe_series_step(&look->probes, session, error);
    while (ok && session->run.info.within_frame);
    world_is_valid(session->run.world); /* waits for a GPU, as part of the timing */
    look->step_seconds += (wall_ms() - begin) / 1000;
    return ok;
}

static bool add_forces(Session *session, const Args *args, RunProgress *look, Error *error)
{
    Forces forces;
    Run *run = &session->run;
    if (!options_of_run(args)->forces)
        return true;
    probe_series_forces(&look->probes, session, &forces);
    return run_agree(run, !run_is_first(run) || forces_log_add(&look->forces, run->info.time, &forces, error),
                     error);
}

static bool add_snapshot(SnapshotSeries *series, const Session *session, RunProgress *look, Error *error)
{
    const size_t before = snapshot_steps(series->file);
    if (!snapshot_series_add(series, session, error))
        return false;
    if (snapshot_steps(series->file) == before)
        return true;
    Cloud cloud = {.count = 0};
    const bool read =
        cloud_read(&cloud, session->run.world) ||
        error_set(error, "no memory to read %zu particles; use a larger spacing", session->run.info.count);
    const bool all = run_agree(&session->run, read, error);
    if (all)
        compression_add(&look->compression, &cloud, &session->run.scene.world);
    cloud_free(&cloud);
    return all;
}

/* Runs from the first state to the last, with a snapshot of the first state at or after each multiple of
   --every. A signal ends the run early, with a complete file. */
static bool simulate(Session *session, const Args *args, SnapshotWriter *file, RunProgress *look,
                     Progress *progress, Error *error)
{
    SnapshotSeries series = {.file = file, .every = options_of_run(args)->every};
    if (!args->quiet) /* the file has its times */
        session_warn_uneven(session, "snapshots", options_of_run(args)->every, args->time);
    if (snapshot_steps(file) > 0)
        snapshot_series_resume(&series, session);
    for (;;) {
        if (!add_snapshot(&series, session, look, error))
            return false;
        if (session_reached(session, args->time) || session_interrupted(session))
            return true;
        world_stop_at(session->run.world, series.next * series.every);
        if (!step(session, look, error)) {
            keep_last(session, file);
            return false;
        }
        if (!add_forces(session, args, look, error) || !probe_series_frame(&look->probes, session, error))
            return false;
        progress_update(progress, session->run.info.time / args->time);
    }
}

/* Prints the reason and returns the exit code. */
static int complain(const Session *session, int code, const Error *error)
{
    if (run_is_first(&session->run))
        fprintf(stderr, "%s\n", error->message);
    return code;
}

static bool draw_probes(const Session *session, const Args *args, const RunProgress *look, Error *error)
{
    const char *probes = options_of_run(args)->probes;
    return run_agree(&session->run,
                     !run_is_first(&session->run) || run_probes_draw(&look->probes, session, probes, error),
                     error);
}

static int finish(const Session *session, const Args *args, const SnapshotWriter *file, RunProgress *look,
                  Error *error)
{
    const RunOptions *own = options_of_run(args);
    const RunRanks *ranks = session->run.ranks;
    if (ranks) {
        ranks->sum(&look->compression.particles, COMPRESSION_SUMS);
        ranks->most(&look->compression.most, 2);
    }
    const CompressionFigures pressed = compression_figures(&look->compression);
    Summary summary = {.command = "run",
                       .product = "snapshots",
                       .products = snapshot_steps(file),
                       .step_seconds = look->step_seconds,
                       .compression = look->compression.states ? &pressed : NULL,
                       .forces = own->forces ? &look->forces : NULL,
                       .probes = own->probes ? &look->probes.table : NULL,
                       .stopped = !session_reached(session, args->time)};
    if (!look->complete)
        session_report(session, args, &summary);
    if (!session_write_json(session, args, &summary, error))
        return complain(session, EXIT_FAILED, error);
    const int code = draw_probes(session, args, look, error) ? 0 : complain(session, EXIT_FAILED, error);
    return summary.stopped ? EXIT_INTERRUPTED : code;
}

static int fail(const Session *session, const Args *args, const SnapshotWriter *file, const RunProgress *look,
                const Error *error)
{
    Error why = {{0}};
    const Summary summary = {
        .command = "run", .product = "snapshots", .products = file ? snapshot_steps(file) : 0};
    const int code = session_fail(session, args, &summary, error);
    if (run_is_first(&session->run))
        snapshot_series_report_left(file, args->output);
    if (!draw_probes(session, args, look, &why))
        complain(session, code, &why);
    return code;
}

/* Opens the file to continue, and loads the last state of the file. */
static SnapshotWriter *open_resumed(Session *session, const Args *args, bool *busy, Error *error)
{
    Run *run = &session->run;
    WorldState state = {.count = 0};
    SnapshotWriter *file =
        snapshot_resume_parallel(args->output, &run->scene, device_replay_mark(session->hand),
                                 run->ranks ? run->ranks->file : NULL, &state, busy, error);
    Error why = {{0}};
    if (file && run->ranks)
        run->ranks->spread(&state, &run->scene.world);
    if (file && !run_agree(run, world_load(run->world, &state, &why), &why)) {
        error_set(error, "%.300s: cannot be resumed: %.600s", args->output, why.message);
        snapshot_close(file);
        file = NULL;
    }
    world_state_free(&state);
    world_info(run->world, &run->info);
    run->watch.resumed = true;
    return file;
}

static void tell_resumed(const Session *session, const Args *args, const SnapshotWriter *file, bool complete)
{
    const double time = session->run.info.time;
    const size_t steps = snapshot_steps(file);
    if (args->quiet || !run_is_first(&session->run))
        return;
    if (complete)
        fprintf(stderr,
                "%s: has %zu snapshot%s to %.4g s, and --time %g s asks for no more: nothing is added\n",
                args->output, steps, plural(steps), time, args->time);
    else
        fprintf(stderr, "%s: goes on from %.4g s, behind %zu snapshot%s\n", args->output, time, steps,
                plural(steps));
}

/* --resume. */
static SnapshotWriter *resume(Session *session, const Args *args, RunProgress *look, bool *busy, Error *error)
{
    Error none = {{0}};
    Run *run = &session->run; /* a file with accelerations needs them in all steps */
    const bool has = !run_is_first(run) || snapshot_file_has(args->output, SCALAR_ACCELERATION_X);
    if (run_agree(run, has, &none) &&
        !(run->scene.world.acceleration = world_keep_acceleration(run->world, error)))
        return NULL;
    SnapshotWriter *file = open_resumed(session, args, busy, error);
    if (file) {
        look->complete = session_reached(session, args->time);
        tell_resumed(session, args, file, look->complete);
    }
    return file;
}

static SnapshotWriter *begin(const Session *session, const Args *args, Error *error)
{
    const RunRanks *ranks = session->run.ranks;
    SnapshotWriter *file =
        snapshot_create_parallel(args->output, &session->run.scene, ranks ? ranks->file : NULL, error);
    if (!file || snapshot_note_motion_source(file, device_replay_mark(session->hand), error))
        return file;
    snapshot_close(file);
    return NULL;
}

/* --forces: continues after the rows of a resumed run. */
static bool begin_forces(const Session *session, const Args *args, bool resumed, RunProgress *look,
                         Error *error)
{
    const Run *run = &session->run;
    return !options_of_run(args)->forces ||
           run_agree(run,
                     !run_is_first(run) ||
                         forces_log_open(&look->forces, options_of_run(args)->forces,
                                         run->scene.world.solid_count, resumed ? run->info.time : -1, error),
                     error);
}

/* True if the probes can be read, and the forces summed. */
static bool check_probes(const Session *session, const Args *args, Error *error)
{
    const RunOptions *own = options_of_run(args);
    const Run *run = &session->run;
    const bool known = !run_is_first(run) || run_probes_check(session, own->probes, args->quiet, error);
    const bool wants_forces = own->forces || (own->probes && probe_list_has_forces(&run->scene.probes));
    return run_agree(run, known, error) && (!wants_forces || world_enable_forces(run->world, error));
}

/* True if the files besides the snapshots can be written. */
static bool check_files(const Session *session, const Args *args, bool resumed, Error *error)
{
    const RunOptions *own = options_of_run(args);
    const bool can = !run_is_first(&session->run) || ((!args->json || json_file_check(args->json, error)) &&
                                                      (!own->forces || output_check(own->forces, error)) &&
                                                      run_probes_check_table(own->probes, resumed, error));
    return run_agree(&session->run, can, error);
}

/* True with --resume and a file to resume, as seen by the first rank. */
static bool goes_on(const Session *session, const Args *args)
{
    Error none = {{0}};
    const bool first = run_is_first(&session->run);
    return options_of_run(args)->resume &&
           run_agree(&session->run, !first || access(args->output, F_OK) == 0, &none);
}

int run_session(Session *session, const Args *args, Error *error)
{
    Progress progress;
    RunProgress look = {.step_seconds = 0};
    SnapshotWriter *file;
    bool busy = false;
    const bool resumed = goes_on(session, args);
    if (!check_probes(session, args, error))
        return complain(session, EXIT_USAGE, error);
    if (!check_files(session, args, resumed, error))
        return complain(session, EXIT_FAILED, error);
    if (resumed) {
        file = resume(session, args, &look, &busy, error);
        if (!file)
            return busy ? fail(session, args, NULL, &look, error) : complain(session, EXIT_USAGE, error);
    } else if (!(file = begin(session, args, error))) {
        return fail(session, args, NULL, &look, error);
    }
    progress_begin(&progress, stderr, "run", args->quiet || !run_is_first(&session->run));
    bool done = begin_forces(session, args, resumed, &look, error) &&
                run_probes_begin(&look.probes, session, options_of_run(args)->probes, resumed, error) &&
                (look.complete || simulate(session, args, file, &look, &progress, error));
    progress_end(&progress);
    Error none = {{0}}, *why = done ? error : &none;
    done &= run_agree(&session->run, forces_log_close(&look.forces, why), why);
    why = done ? error : &none;
    done &= run_agree(&session->run, probe_series_close(&look.probes, why), why);
    int code = done ? finish(session, args, file, &look, error) : fail(session, args, file, &look, error);
    snapshot_close(file);
    probe_series_free(&look.probes);
    return code;
}

/* The plot has its table as a second file. */
static void files_probes(CommandFiles *files, const OptionRow *row, const char *output)
{
    const char *dot = strrchr(output, '.');
    files_replaced(files, row, output);
    if (dot && strcasecmp(dot, ".csv") != 0)
        command_files_add_beside(files, "the table of --probes", output, strlen(dot), ".csv", NULL);
}

static int run_command(const Args *args)
{
    Session session = {.run.world = NULL};
    Error error = {{0}};
    interrupt_install();
    int code = snapshot_series_check_name(args->output, &error)
                   ? session_open(&session, args, options_of_run(args)->resume, &error)
                   : EXIT_USAGE;
    if (code == 0)
        code = run_session(&session, args, &error);
    else if (code == EXIT_FAILED)
        fail(&session, args, NULL, &(RunProgress){.step_seconds = 0}, &error);
    else
        complain(&session, code, &error);
    session_close(&session);
    return code;
}

/* clang-format off */
static const OptionRow options[] = {
    ROW_OUTPUT_FILE,
    ROW_TIME(5, "simulated seconds (5)"),
    ROW_EVERY(RunOptions),
    {"--forces", "FILE", OPTION_TEXT, OWN(RunOptions, forces), .files = files_replaced,
     .help = "what the fluid does to the box and to each solid, N and N m, a row a frame, as CSV; not with backend fragment"},
    {"--probes", "FILE", OPTION_TEXT, OWN(RunOptions, probes), .files = files_probes,
     .help = "what the scene's probes read, a row a step: FILE.csv; FILE.svg or FILE.png: a plot of that too"},
    {"--resume", NULL, OPTION_FLAG, OWN(RunOptions, resume), .help = "go on behind the last snapshot of OUT, to the same bits"},
    ROWS_SCENE, ROW_VIEW, ROW_PRESET, ROWS_PROCESSOR, ROW_GPU, ROW_SHADERS, ROWS_DEVICE_MOVES, ROW_JSON, ROWS_END
};
/* clang-format on */

const Command command_run = {
    .name = "run",
    .usage = "SCENE -o OUT.h5part [OPTIONS]",
    .help = "simulates a scene into snapshots that ParaView opens",
    .takes = "scene",
    .takes_min = 1,
    .takes_max = 1,
    .output = "OUT.h5part",
    .own_size = sizeof(RunOptions),
    .argument_files = files_scene,
    .options = options,
    .run = run_command,
};
