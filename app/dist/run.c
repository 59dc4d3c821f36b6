#include "app/base/file.h"
#include "app/base/output.h"
#include "app/base/program.h"
#include "app/dist/cmd.h"
#include "app/dist/forces.h"
#include "app/dist/probes.h"
#include "app/dist/share.h"
#include "app/dist/stand.h"
#include "app/run/session.h"
#include "sim/base/stage.h"
#include "sim/dist/dist.h"
#include "sim/dist/ranks.h"

#include <math.h>
#include <mpi.h>
#include <stdio.h>
#include <unistd.h>

typedef struct DistRun {
    const Args *args;
    Stand stand;
    SnapshotWriter *file; /* written by all ranks */
    double next;          /* number of the next snapshot */
    double step_seconds;  /* wall time of the steps, without writing */
    ForcesLog forces;     /* of --forces, on the first rank */
    DistProbes probes;    /* of --probes */
} DistRun;

/* Refuses options of slosh run missing here. */
static bool check_options(const Args *args, Error *error)
{
    if (args->device)
        return error_set(error, "slosh-dist run: it has no --device yet; use slosh run");
    return snapshot_series_check_name(args->output, error);
}

static bool add_snapshot(DistRun *run, Error *error)
{
    const Session *session = &run->stand.session;
    if (!session_reached(session, run->next * run->args->every))
        return true;
    if (!snapshot_append(run->file, session->world, error))
        return false;
    run->next = fmax(run->next, floor(session->info.time / run->args->every + 1e-6)) + 1;
    return true;
}

static bool frame(DistRun *run, Error *error)
{
    const double begin = wall_ms();
    bool ok = true;
    do
        ok = stand_substep(&run->stand, error) && dist_probes_step(&run->probes, &run->stand, error);
    while (ok && run->stand.session.info.within_frame);
    run->step_seconds += (wall_ms() - begin) / 1000;
    return ok && dist_forces_frame(&run->forces, &run->probes.series, &run->stand, run->args, error) &&
           dist_probes_frame(&run->probes, &run->stand, error);
}

/* Returns false, on all ranks, if the simulation broke or a file cannot be written. */
static bool simulate(DistRun *run, Progress *progress, Error *error)
{
    const Session *session = &run->stand.session;
    for (;;) {
        if (!add_snapshot(run, error))
            return false;
        if (session_reached(session, run->args->time) || stand_interrupted())
            return true;
        world_stop_at(session->world, run->next * run->args->every);
        if (!frame(run, error))
            return false;
        progress_update(progress, session->info.time / run->args->time);
    }
}

/* ---- final report, by the first rank ---- */

static Summary summary_of(const DistRun *run)
{
    return (Summary){.command = "run",
                     .product = "snapshots",
                     .products = run->file ? snapshot_steps(run->file) : 0,
                     .step_seconds = run->step_seconds,
                     .forces = run->args->forces ? &run->forces : NULL,
                     .probes = run->probes.probes ? &run->probes.series.table : NULL,
                     .stopped = !session_reached(&run->stand.session, run->args->time)};
}

static bool write_json(const DistRun *run, Error *error)
{
    const Summary summary = summary_of(run);
    if (!run->args->json)
        return true;
    json_t *json = session_json(&run->stand.session, run->args, &summary);
    json_object_set_new(json, "ranks", json_integer(run->stand.size));
    const bool written = json_file_write(json, run->args->json, error);
    json_decref(json);
    return written;
}

static int finish(const DistRun *run, Error *error)
{
    const Summary summary = summary_of(run);
    bool ok = true;
    if (run->stand.rank == 0) {
        session_report(&run->stand.session, run->args, &summary);
        ok = write_json(run, error);
    }
    if (!dist_agree(ok, error)) {
        stand_say(&run->stand, error->message);
        return EXIT_FAILED;
    }
    return summary.stopped ? EXIT_INTERRUPTED : 0;
}

static int fail(const DistRun *run, const Error *error)
{
    const Summary summary = summary_of(run);
    if (run->stand.rank == 0) {
        session_fail(&run->stand.session, run->args, &summary, error);
        snapshot_series_report_left(run->file, run->args->output);
    }
    return EXIT_FAILED;
}

/* ---- start ---- */

/* --resume with an existing file: loads the state at the file's end, written on any count of ranks. */
static bool resume(DistRun *run, Error *error)
{
    WorldState state = {.count = 0};
    Session *session = &run->stand.session;
    run->file = snapshot_resume_parallel(run->args->output, &session->scene, dist_share(), &state, error);
    if (!run->file)
        return false;
    ranks_spread(&state, &session->scene.world);
    if (!world_load(session->world, &state, error))
        dist_die("%s", error->message);
    world_state_free(&state);
    world_info(session->world, &session->info);
    run->next = floor(session->info.time / run->args->every + 1e-6) + 1;
    if (run->stand.rank == 0 && !run->args->quiet)
        fprintf(stderr, "%s: goes on from %.4g s, behind %zu snapshot%s\n", run->args->output,
                session->info.time, snapshot_steps(run->file), plural(snapshot_steps(run->file)));
    return true;
}

/* As seen by the first rank. */
static bool is_there(const DistRun *run)
{
    int there = run->stand.rank == 0 && access(run->args->output, F_OK) == 0;
    MPI_Bcast(&there, 1, MPI_INT, 0, MPI_COMM_WORLD);
    return there;
}

static bool check_files(const DistRun *run, bool goes_on, Error *error)
{
    const Args *args = run->args;
    const bool ok = run->stand.rank > 0 || !args->json || json_file_check(args->json, error);
    return dist_agree(ok, error) && dist_forces_check(&run->stand, args, error) &&
           dist_probes_check_table(&run->stand, args, goes_on, error);
}

static bool begin_file(DistRun *run, bool goes_on, Error *error)
{
    if (goes_on)
        return resume(run, error);
    run->file = snapshot_create_parallel(run->args->output, &run->stand.session.scene, dist_share(), error);
    return run->file != NULL;
}

static int go(DistRun *run, Error *error)
{
    Progress progress;
    Stand *stand = &run->stand;
    const bool goes_on = run->args->resume && is_there(run);
    const bool asked_well =
        dist_probes_check(stand, run->args, error) && dist_forces_feel(stand, run->args, error);
    if (!asked_well || !check_files(run, goes_on, error)) {
        stand_say(stand, error->message);
        return asked_well ? EXIT_FAILED : EXIT_USAGE;
    }
    if (!begin_file(run, goes_on, error))
        return fail(run, error);
    progress_begin(&progress, stderr, "run", run->args->quiet || stand->rank > 0);
    bool done = dist_forces_begin(&run->forces, stand, run->args, goes_on, error) &&
                dist_probes_begin(&run->probes, stand, run->args, goes_on, error) &&
                simulate(run, &progress, error);
    progress_end(&progress);
    Error none = {{0}};
    done &= dist_forces_end(&run->forces, done ? error : &none);
    done &= dist_probes_end(&run->probes, stand, run->args, done ? error : &none);
    return done ? finish(run, error) : fail(run, error);
}

int dist_run(const Args *args)
{
    static DistRun run; /* a scene is large */
    Error error = {{0}};
    run = (DistRun){.args = args};
    stand_begin(&run.stand);
    int code = check_options(args, &error) ? stand_open(&run.stand, args, "run", &error) : EXIT_USAGE;
    if (code == 0)
        code = go(&run, &error);
    else
        stand_say(&run.stand, error.message);
    snapshot_close(run.file);
    dist_probes_free(&run.probes);
    world_destroy(run.stand.session.world);
    return code;
}
