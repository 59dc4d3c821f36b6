#include "app/base/exit_code.h"
#include "app/base/interrupt.h"
#include "app/base/output.h"
#include "app/base/progress.h"
#include "app/dist/cmd.h"
#include "app/dist/stand.h"
#include "app/output/snapshot.h"
#include "app/session/snapshot_series.h"
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
    Snapshot *file; /* of the first rank */
    double next;    /* number of the next snapshot */
    double began;   /* s */
} DistRun;

/* What one rank found wrong alone: all end. What is in the file stays. */
static _Noreturn void end_all(DistRun *run, const Error *error)
{
    fprintf(stderr, "%s\n", error->message);
    snapshot_series_left(run->file, run->args->output);
    snapshot_close(run->file);
    fflush(stderr);
    MPI_Abort(MPI_COMM_WORLD, EXIT_FAILED);
    abort();
}

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

/* The others bring their particles to the first rank. */
static void add_snapshot(DistRun *run)
{
    Error error = {{0}};
    if (!reached(run, run->next * run->args->every))
        return;
    if (run->stand.rank > 0)
        world_read(run->stand.world, &(ParticleArrays){.position = NULL});
    else if (!snapshot_append(run->file, run->stand.world, &error))
        end_all(run, &error);
    run->next = fmax(run->next, floor(run->stand.info.time / run->args->every + 1e-6)) + 1;
}

/* False when the simulation broke, on all ranks. */
static bool simulate(DistRun *run, Progress *progress, Error *error)
{
    for (;;) {
        add_snapshot(run);
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
 * ranks. */
static void resume(DistRun *run)
{
    WorldState state = {.count = 0};
    Error error = {{0}};
    bool busy;
    if (run->stand.rank == 0 &&
        !(run->file = snapshot_resume(run->args->output, &run->stand.scene, "", &state, &busy, &error)))
        end_all(run, &error);
    ranks_spread(&state, &run->stand.scene.world);
    if (!world_load(run->stand.world, &state, &error))
        end_all(run, &error);
    world_state_free(&state);
    world_info(run->stand.world, &run->stand.info);
    run->next = floor(run->stand.info.time / run->args->every + 1e-6) + 1;
    if (run->stand.rank == 0 && !run->args->quiet)
        fprintf(stderr, "%s: goes on from %.4g s, behind %zu snapshot%s\n", run->args->output,
                run->stand.info.time, snapshot_steps(run->file), plural(snapshot_steps(run->file)));
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
    if (run->args->resume && is_there(run))
        resume(run);
    else if (run->stand.rank == 0 &&
             !(run->file = snapshot_create(run->args->output, &run->stand.scene, error)))
        end_all(run, error);
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
