#include "app/base/file.h"
#include "app/base/output.h"
#include "app/base/program.h"
#include "app/bench/probe_plot.h"
#include "app/cli/cli_private.h"
#include "app/files/forces_log.h"
#include "app/run/measure/metric.h"
#include "app/run/session.h"

#include <stdio.h>
#include <unistd.h>

/* After trouble that smaller steps did not cure, keeps the world's last good state, for inspection. */
static void keep_last(const Session *session, SnapshotWriter *file)
{
    Error none = {{0}};
    if (session->scene.world.retries > 0 && session->info.time > snapshot_time(file))
        snapshot_append(file, session->world, &none);
}

/* Figures of the states with a snapshot. */
typedef struct RunProgress {
    Cloud cloud;
    CompressionTally compression;
    double step_seconds; /* wall time of the steps, without writing */
    ForcesLog forces;    /* of --forces */
    ProbeSeries probes;  /* of --probes */
} RunProgress;

static bool step(Session *session, RunProgress *look, Error *error)
{
    const double begin = wall_ms();
    bool ok = true;
    do
        ok = session_substep(session, error) && probe_series_step(&look->probes, session, error);
    while (ok && session->info.within_frame);
    world_is_valid(session->world); /* waits for a GPU, as part of the timing */
    look->step_seconds += (wall_ms() - begin) / 1000;
    return ok;
}

static bool add_forces(Session *session, RunProgress *look, Error *error)
{
    Forces forces;
    if (!look->forces.file)
        return true;
    probe_series_forces(&look->probes, session, &forces);
    return forces_log_add(&look->forces, session->info.time, &forces, error);
}

static bool add_snapshot(SnapshotSeries *series, const Session *session, RunProgress *look, Error *error)
{
    const size_t before = snapshot_steps(series->file);
    if (!snapshot_series_add(series, session, error))
        return false;
    if (snapshot_steps(series->file) == before)
        return true;
    if (!cloud_read(&look->cloud, session->world))
        return error_set(error, "no memory to read %zu particles; use a larger spacing", session->info.count);
    compression_add(&look->compression, &look->cloud, &session->scene.world);
    return true;
}

/* Runs from the first state to the last, with a snapshot of the first state at or after each multiple of
   --every. A signal ends the run early, with a complete file. */
static bool simulate(Session *session, const Args *args, SnapshotWriter *file, RunProgress *look,
                     Progress *progress, Error *error)
{
    SnapshotSeries series = {.file = file, .every = args->every};
    if (!args->quiet) /* the file has its times */
        session_warn_uneven(session, "snapshots", args->every, args->time);
    if (snapshot_steps(file) > 0)
        snapshot_series_resume(&series, session);
    for (;;) {
        if (!add_snapshot(&series, session, look, error))
            return false;
        if (session_reached(session, args->time) || interrupted())
            return true;
        world_stop_at(session->world, series.next * series.every);
        if (!step(session, look, error)) {
            keep_last(session, file);
            return false;
        }
        if (!add_forces(session, look, error) || !probe_series_frame(&look->probes, session, error))
            return false;
        progress_update(progress, session->info.time / args->time);
    }
}

static int complain(int code, const Error *error)
{
    fprintf(stderr, "%s\n", error->message);
    return code;
}

static int finish(const Session *session, const Args *args, const SnapshotWriter *file,
                  const RunProgress *look, Error *error)
{
    const CompressionFigures pressed = compression_figures(&look->compression);
    Summary summary = {.command = "run",
                       .product = "snapshots",
                       .products = snapshot_steps(file),
                       .step_seconds = look->step_seconds,
                       .compression = look->compression.states ? &pressed : NULL,
                       .forces = args->forces ? &look->forces : NULL,
                       .probes = args->probes ? &look->probes.table : NULL,
                       .stopped = !session_reached(session, args->time)};
    session_report(session, args, &summary);
    if (!session_write_json(session, args, &summary, error))
        return complain(EXIT_FAILED, error);
    const int code = run_probes_draw(&look->probes, session, args, error) ? 0 : complain(EXIT_FAILED, error);
    return summary.stopped ? EXIT_INTERRUPTED : code;
}

static int fail(const Session *session, const Args *args, const SnapshotWriter *file, const RunProgress *look,
                const Error *error)
{
    Error why;
    const Summary summary = {
        .command = "run", .product = "snapshots", .products = file ? snapshot_steps(file) : 0};
    const int code = session_fail(session, args, &summary, error);
    snapshot_series_report_left(file, args->output);
    if (!run_probes_draw(&look->probes, session, args, &why))
        complain(code, &why);
    return code;
}

/* --resume: opens the file to continue, and loads the world's state from its end. */
static SnapshotWriter *resume(Session *session, const Args *args, bool *busy, Error *error)
{
    WorldState state = {.count = 0};
    Scene *scene = &session->scene; /* a file with accelerations needs them in all steps */
    if (snapshot_file_has(args->output, SCALAR_ACCELERATION_X) &&
        !(scene->world.acceleration = world_keep_acceleration(session->world, error)))
        return NULL;
    SnapshotWriter *file = snapshot_resume(args->output, &session->scene, device_replay_mark(session->hand),
                                           &state, busy, error);
    Error why = {{0}};
    if (file && !world_load(session->world, &state, &why)) {
        error_set(error, "%.300s: cannot be resumed: %.600s", args->output, why.message);
        snapshot_close(file);
        file = NULL;
    }
    world_state_free(&state);
    world_info(session->world, &session->info);
    if (file && !args->quiet)
        fprintf(stderr, "%s: goes on from %.4g s, behind %zu snapshot%s\n", args->output, session->info.time,
                snapshot_steps(file), plural(snapshot_steps(file)));
    return file;
}

static SnapshotWriter *begin(const Session *session, const Args *args, Error *error)
{
    SnapshotWriter *file = snapshot_create(args->output, &session->scene, error);
    if (!file || snapshot_note_motion_source(file, device_replay_mark(session->hand), error))
        return file;
    snapshot_close(file);
    return NULL;
}

/* --forces: continues after the rows of a resumed run. */
static bool begin_forces(const Session *session, const Args *args, bool resumed, RunProgress *look,
                         Error *error)
{
    if (!args->forces)
        return true;
    return forces_log_open(&look->forces, args->forces, session->scene.world.solid_count,
                           resumed ? session->info.time : -1, error);
}

static int run(Session *session, const Args *args, Error *error)
{
    Progress progress;
    RunProgress look = {.step_seconds = 0};
    SnapshotWriter *file;
    bool busy = false;
    const bool resumed = args->resume && access(args->output, F_OK) == 0;
    const bool feels = args->forces || (args->probes && probe_list_has_forces(&session->scene.probes));
    if (!run_probes_check(session, args, error) || (feels && !world_enable_forces(session->world, error)))
        return complain(EXIT_USAGE, error);
    if ((args->json && !json_file_check(args->json, error)) ||
        (args->forces && !output_check(args->forces, error)) || !run_probes_check_table(args, resumed, error))
        return complain(EXIT_FAILED, error);
    if (resumed) {
        file = resume(session, args, &busy, error);
        if (!file)
            return busy ? fail(session, args, NULL, &look, error) : complain(EXIT_USAGE, error);
    } else if (!(file = begin(session, args, error))) {
        return fail(session, args, NULL, &look, error);
    }
    progress_begin(&progress, stderr, "run", args->quiet);
    bool done = begin_forces(session, args, resumed, &look, error) &&
                run_probes_begin(&look.probes, session, args, resumed, error) &&
                simulate(session, args, file, &look, &progress, error);
    progress_end(&progress);
    Error none = {{0}};
    done &= forces_log_close(&look.forces, done ? error : &none);
    done &= probe_series_close(&look.probes, done ? error : &none);
    int code = done ? finish(session, args, file, &look, error) : fail(session, args, file, &look, error);
    snapshot_close(file);
    cloud_free(&look.cloud);
    probe_series_free(&look.probes);
    return code;
}

int cmd_run(const Args *args)
{
    Session session = {.world = NULL};
    Error error = {{0}};
    interrupt_install();
    int code =
        snapshot_series_check_name(args->output, &error) ? session_open(&session, args, &error) : EXIT_USAGE;
    if (code == 0)
        code = run(&session, args, &error);
    else if (code == EXIT_FAILED)
        fail(&session, args, NULL, &(RunProgress){.step_seconds = 0}, &error);
    else
        complain(code, &error);
    session_close(&session);
    return code;
}
