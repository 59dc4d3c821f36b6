#include "app/base/exit_code.h"
#include "app/base/interrupt.h"
#include "app/base/output.h"
#include "app/base/progress.h"
#include "app/dist/cmd.h"
#include "app/output/snapshot.h"
#include "app/session/session.h"
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
    Scene scene; /* with the backend that its file names */
    World *world;
    WorldInfo info;
    Snapshot *file; /* of the first rank */
    int rank, size;
    double next; /* number of the next snapshot */
    TroubleTold told;
    double began; /* s */
} DistRun;

/* Says it once. */
static void say(const DistRun *run, const char *words)
{
    if (run->rank == 0)
        fprintf(stderr, "%s\n", words);
}

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
static bool check_options(const Args *args, const Scene *scene, Error *error)
{
    const char *refused = args->forces   ? "--forces"
                          : args->probes ? "--probes"
                          : args->device ? "--device"
                                         : NULL;
    if (refused)
        return error_set(error, "slosh-dist run: it has no %s yet; use slosh run", refused);
    if (args->json)
        return error_set(error, "slosh-dist run: it has no --json yet");
    return strcmp(scene->world.backend, "cpu") == 0 ||
           error_set(error,
                     "slosh-dist run: it has backend cpu alone, not %s; use slosh run, or --backend cpu",
                     scene->world.backend);
}

/* Of the processors that the ranks of a machine share. */
static int threads_each(void)
{
    MPI_Comm machine;
    int ranks;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
    MPI_Comm_size(machine, &ranks);
    MPI_Comm_free(&machine);
    const int each = world_processors() / ranks;
    return each > 1 ? each : 1;
}

static int open_scene(DistRun *run, Error *error)
{
    Notes notes;
    SceneSettings settings = run->args->settings;
    if (!snapshot_series_name(run->args->output, error) ||
        !scene_load(run->args->scenes[0], &settings, &run->scene, &notes, error) ||
        !check_options(run->args, &run->scene, error))
        return EXIT_USAGE;
    if (run->rank == 0)
        notes_print(&notes, stderr);
    WorldDef def = run->scene.world;
    snprintf(def.backend, sizeof def.backend, "%s", RANKS_BACKEND);
    if (*world_threads(&def) == 0)
        *world_threads(&def) = threads_each();
    run->world = world_create(&def, error);
    if (!run->world)
        return EXIT_USAGE;
    world_info(run->world, &run->info);
    return 0;
}

static bool reached(const DistRun *run, double time)
{
    return run->info.time >= time - ROUNDING * run->scene.world.dt && world_sound(run->world);
}

/* The others bring their particles to the first rank. */
static void add_snapshot(DistRun *run)
{
    Error error = {{0}};
    if (!reached(run, run->next * run->args->every))
        return;
    if (run->rank > 0)
        world_read(run->world, &(ParticleArrays){.position = NULL});
    else if (!snapshot_append(run->file, run->world, &error))
        end_all(run, &error);
    run->next = fmax(run->next, floor(run->info.time / run->args->every + 1e-6)) + 1;
}

static bool any_interrupted(void)
{
    int any = interrupted();
    MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    return any;
}

static bool frame(DistRun *run, Error *error)
{
    char words[256];
    bool ok = true;
    do {
        ok = world_substep(run->world, NULL, error);
        world_info(run->world, &run->info);
        if (session_trouble_is_new(&run->told, &run->info.trouble))
            say(run, session_trouble_text(&run->info.trouble, words));
    } while (ok && run->info.within_frame);
    return ok;
}

/* False when the simulation broke, on all ranks. */
static bool simulate(DistRun *run, Progress *progress, Error *error)
{
    for (;;) {
        add_snapshot(run);
        if (reached(run, run->args->time) || any_interrupted())
            return true;
        world_stop_at(run->world, run->next * run->args->every);
        if (!frame(run, error))
            return false;
        progress_update(progress, run->info.time / run->args->time);
    }
}

static void report(const DistRun *run)
{
    const double wall = MPI_Wtime() - run->began;
    if (run->rank == 0 && !run->args->quiet)
        fprintf(stderr, "%zu particles on %d rank%s, %.3g s simulated in %.3g s: %s, %zu snapshots\n",
                run->info.count, run->size, plural((size_t)run->size), run->info.time, wall,
                run->args->output, snapshot_steps(run->file));
}

/* --resume, where the file is there: the world as it is at the file's end, whoever wrote it on how many
 * ranks. */
static void resume(DistRun *run)
{
    WorldState state = {.count = 0};
    Error error = {{0}};
    bool busy;
    if (run->rank == 0 &&
        !(run->file = snapshot_resume(run->args->output, &run->scene, "", &state, &busy, &error)))
        end_all(run, &error);
    ranks_spread(&state, &run->scene.world);
    if (!world_load(run->world, &state, &error))
        end_all(run, &error);
    world_state_free(&state);
    world_info(run->world, &run->info);
    run->next = floor(run->info.time / run->args->every + 1e-6) + 1;
    if (run->rank == 0 && !run->args->quiet)
        fprintf(stderr, "%s: goes on from %.4g s, behind %zu snapshot%s\n", run->args->output, run->info.time,
                snapshot_steps(run->file), plural(snapshot_steps(run->file)));
}

/* As the first rank sees it. */
static bool is_there(const DistRun *run)
{
    int there = run->rank == 0 && access(run->args->output, F_OK) == 0;
    MPI_Bcast(&there, 1, MPI_INT, 0, MPI_COMM_WORLD);
    return there;
}

static int go(DistRun *run, Error *error)
{
    Progress progress;
    if (run->args->resume && is_there(run))
        resume(run);
    else if (run->rank == 0 && !(run->file = snapshot_create(run->args->output, &run->scene, error)))
        end_all(run, error);
    progress_begin(&progress, stderr, "run", run->args->quiet || run->rank > 0);
    const bool done = simulate(run, &progress, error);
    progress_end(&progress);
    if (!done) {
        say(run, error->message);
        if (run->rank == 0)
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
    MPI_Comm_rank(MPI_COMM_WORLD, &run.rank);
    MPI_Comm_size(MPI_COMM_WORLD, &run.size);
    interrupt_install();
    int code = open_scene(&run, &error);
    if (code == 0)
        code = go(&run, &error);
    else
        say(&run, error.message);
    snapshot_close(run.file);
    world_destroy(run.world);
    return code;
}
