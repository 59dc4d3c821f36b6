#include "app/base/exit_code.h"
#include "app/base/interrupt.h"
#include "app/base/output.h"
#include "app/base/progress.h"
#include "app/dist/cmd.h"
#include "app/dist/share.h"
#include "app/dist/stand.h"
#include "app/session/snapshot_series.h"
#include "sim/dist/dist.h"
#include "sim/dist/ranks.h"

#include <math.h>
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* A state this small part of a frame early is on time, as in app/session/session.c. */
static const double ROUNDING = 1e-6;

typedef struct DistRun {
    const Args *args;
    Stand stand;
    Snapshot *file; /* that all write */
    double next;    /* number of the next snapshot */
    double began;   /* s */
} DistRun;

/* What slosh run has and this has not. */
static bool check_options(const Args *args, Error *error)
{
    const char *refused = args->forces   ? "--forces"
                          : args->probes ? "--probes"
                          : args->device ? "--device"
                          : args->json   ? "--json"
                                         : NULL;
    if (refused)
        return error_set(error, "slosh-dist run: it has no %s yet; use slosh run", refused);
    return snapshot_series_name(args->output, error);
}

static bool reached(const DistRun *run, double time)
{
    return run->stand.info.time >= time - ROUNDING * run->stand.scene.world.dt &&
           world_sound(run->stand.world);
}

static bool add_snapshot(DistRun *run, Error *error)
{
    if (!reached(run, run->next * run->args->every))
        return true;
    if (!snapshot_append(run->file, run->stand.world, error))
        return false;
    run->next = fmax(run->next, floor(run->stand.info.time / run->args->every + 1e-6)) + 1;
    return true;
}

/* False when the simulation broke or the file cannot be written, on all ranks. */
static bool simulate(DistRun *run, Progress *progress, Error *error)
{
    for (;;) {
        if (!add_snapshot(run, error))
            return false;
        if (reached(run, run->args->time) || stand_interrupted())
            return true;
        world_stop_at(run->stand.world, run->next * run->args->every);
        if (!stand_frame(&run->stand, error))
            return false;
        progress_update(progress, run->stand.info.time / run->args->time);
    }
}

static void report(const DistRun *run)
{
    const double wall = MPI_Wtime() - run->began;
    if (run->stand.rank == 0 && !run->args->quiet)
        fprintf(stderr, "%zu particles on %d rank%s, %.3g s simulated in %.3g s: %s, %zu snapshots\n",
                run->stand.info.count, run->stand.size, plural((size_t)run->stand.size), run->stand.info.time,
                wall, run->args->output, snapshot_steps(run->file));
}

/* --resume, where the file is there: the world as it is at the file's end, whoever wrote it on how many
   ranks. */
static bool resume(DistRun *run, Error *error)
{
    WorldState state = {.count = 0};
    run->file = snapshot_resume_shared(run->args->output, &run->stand.scene, dist_share(), &state, error);
    if (!run->file)
        return false;
    ranks_spread(&state, &run->stand.scene.world);
    if (!world_load(run->stand.world, &state, error))
        dist_die("%s", error->message);
    world_state_free(&state);
    world_info(run->stand.world, &run->stand.info);
    run->next = floor(run->stand.info.time / run->args->every + 1e-6) + 1;
    if (run->stand.rank == 0 && !run->args->quiet)
        fprintf(stderr, "%s: goes on from %.4g s, behind %zu snapshot%s\n", run->args->output,
                run->stand.info.time, snapshot_steps(run->file), plural(snapshot_steps(run->file)));
    return true;
}

/* As the first rank sees it. */
static bool is_there(const DistRun *run)
{
    int there = run->stand.rank == 0 && access(run->args->output, F_OK) == 0;
    MPI_Bcast(&there, 1, MPI_INT, 0, MPI_COMM_WORLD);
    return there;
}

static int go(DistRun *run, Error *error)
{
    Progress progress;
    const bool goes_on = run->args->resume && is_there(run);
    if (!goes_on)
        run->file = snapshot_create_shared(run->args->output, &run->stand.scene, dist_share(), error);
    if (goes_on ? !resume(run, error) : !run->file) {
        stand_say(&run->stand, error->message);
        return EXIT_FAILED;
    }
    progress_begin(&progress, stderr, "run", run->args->quiet || run->stand.rank > 0);
    const bool done = simulate(run, &progress, error);
    progress_end(&progress);
    if (!done) {
        stand_say(&run->stand, error->message);
        if (run->stand.rank == 0)
            snapshot_series_left(run->file, run->args->output);
        return EXIT_FAILED;
    }
    report(run);
    return reached(run, run->args->time) ? 0 : EXIT_INTERRUPTED;
}

int dist_run(const Args *args)
{
    static DistRun run; /* a scene is large */
    Error error = {{0}};
    run = (DistRun){.args = args, .began = MPI_Wtime()};
    stand_begin(&run.stand);
    int code = check_options(args, &error) ? stand_open(&run.stand, args, "run", &error) : EXIT_USAGE;
    if (code == 0)
        code = go(&run, &error);
    else
        stand_say(&run.stand, error.message);
    snapshot_close(run.file);
    world_destroy(run.stand.world);
    return code;
}
