#include "app/ranks/ranks.h"

#include "app/base/file.h"
#include "app/base/output.h"
#include "app/base/program.h"
#include "app/bench/probe_plot.h"
#include "app/run/session.h"
#include "sim/ranks/ranks.h"
#include "slosh/world.h"

#include <math.h>
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct Record {
    ParticleId id;
    uint32_t cell;
    float position[4], velocity[4], density, pressure;
} Record;

/* Allocates memory for `room` entries; old contents are lost. */
static void reserve(void *memory, size_t room, size_t size)
{
    void *at;
    memcpy(&at, memory, sizeof at);
    free(at);
    at = malloc(room * size);
    if (!at)
        dist_die("no memory for the probes; use fewer of them, or a larger spacing");
    memcpy(memory, &at, sizeof at);
}

static bool grows(size_t *room, size_t count)
{
    if (count < *room)
        return false;
    *room = count + count / 4 + 256;
    return true;
}

static void reserve_cloud(Cloud *cloud, size_t room)
{
    reserve(&cloud->position, room, 4 * sizeof *cloud->position);
    reserve(&cloud->velocity, room, 4 * sizeof *cloud->velocity);
    reserve(&cloud->density, room, sizeof *cloud->density);
    reserve(&cloud->pressure, room, sizeof *cloud->pressure);
}

static void read_own(Gathered *gathered, World *world)
{
    const size_t count = ranks_owned();
    if (grows(&gathered->own_room, count)) {
        reserve_cloud(&gathered->own, gathered->own_room);
        reserve(&gathered->id, gathered->own_room, sizeof *gathered->id);
        reserve(&gathered->cell, gathered->own_room, sizeof *gathered->cell);
    }
    ParticleArrays out = {
        .position = gathered->own.position, .velocity = gathered->own.velocity, .whole_id = gathered->id};
    out.scalar[SCALAR_DENSITY] = gathered->own.density;
    out.scalar[SCALAR_PRESSURE] = gathered->own.pressure;
    gathered->own.count = count;
    if (!world_read(world, &out))
        dist_die("no memory to read %zu particles; use a larger spacing", count);
    ranks_cells(gathered->cell);
}

/* Collects this rank's records; returns their count. */
static size_t choose(Gathered *gathered, const Probes *probes)
{
    const Cloud *own = &gathered->own;
    size_t count = 0;
    for (size_t i = 0; i < own->count; i++)
        count += probes_cover(probes, own->position + 4 * i);
    if (grows(&gathered->out_room, count))
        reserve(&gathered->out, gathered->out_room, sizeof(Record));
    Record *record = gathered->out;
    for (size_t i = 0; i < own->count; i++) {
        if (!probes_cover(probes, own->position + 4 * i))
            continue;
        *record = (Record){.cell = gathered->cell[i],
                           .id = gathered->id[i],
                           .density = own->density[i],
                           .pressure = own->pressure[i]};
        memcpy(record->position, own->position + 4 * i, sizeof record->position);
        memcpy(record++->velocity, own->velocity + 4 * i, sizeof record->velocity);
    }
    return count;
}

static int by_place(const void *a, const void *b)
{
    const Record *p = a, *q = b;
    const int cells = (p->cell > q->cell) - (p->cell < q->cell);
    return cells ? cells : (p->id > q->id) - (p->id < q->id);
}

static void put(Gathered *gathered, Record *record, size_t count)
{
    Cloud *cloud = &gathered->cloud;
    if (grows(&gathered->cloud_room, count))
        reserve_cloud(cloud, gathered->cloud_room);
    qsort(record, count, sizeof *record, by_place);
    cloud->count = count;
    for (size_t i = 0; i < count; i++, record++) {
        memcpy(cloud->position + 4 * i, record->position, sizeof record->position);
        memcpy(cloud->velocity + 4 * i, record->velocity, sizeof record->velocity);
        cloud->density[i] = record->density;
        cloud->pressure[i] = record->pressure;
    }
}

/* Collective; ends all ranks if memory is short. */
static void gather_read(Gathered *gathered, const Probes *probes, World *world)
{
    int rank;
    WorldInfo info;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    read_own(gathered, world);
    const size_t count = choose(gathered, probes), all = (size_t)reduce_count((int64_t)count);
    if (rank == 0 && grows(&gathered->in_room, all))
        reserve(&gathered->in, gathered->in_room, sizeof(Record));
    reduce_gather(gathered->out, count, sizeof(Record), rank == 0 ? gathered->in : NULL);
    if (rank > 0)
        return;
    world_info(world, &info);
    gathered->cloud.spacing = info.spacing;
    gathered->cloud.support_radius = info.support_radius;
    put(gathered, gathered->in, all);
}

static void gather_free(Gathered *gathered)
{
    cloud_free(&gathered->cloud);
    cloud_free(&gathered->own);
    free(gathered->out);
    free(gathered->in);
    free(gathered->id);
    free(gathered->cell);
    *gathered = (Gathered){.out = NULL};
}

/* Check if the scene has probes, and if the files can be written. */
static bool dist_probes_check(const RankSession *ranks, const Args *args, Error *error)
{
    return dist_agree(ranks->rank > 0 || run_probes_check(&ranks->session, args, error), error);
}

static bool dist_probes_check_table(const RankSession *ranks, const Args *args, bool resumed, Error *error)
{
    return dist_agree(ranks->rank > 0 || run_probes_check_table(args, resumed, error), error);
}

static bool dist_probes_begin(DistProbes *probes, RankSession *ranks, const Args *args, bool resumed,
                              Error *error)
{
    const Scene *scene = &ranks->session.scene;
    if (!args->probes)
        return true;
    probes->probes = probes_create(&scene->probes, &scene->world);
    if (!probes->probes)
        dist_die("no memory for the probes; use fewer of them");
    gather_read(&probes->gathered, probes->probes, ranks->session.world);
    probes->series.given = &probes->gathered.cloud;
    return dist_agree(
        ranks->rank > 0 || run_probes_begin(&probes->series, &ranks->session, args, resumed, error), error);
}

/* Call dist_probes_step after each step, dist_probes_frame at the end of each frame. */
static bool dist_probes_step(DistProbes *probes, const RankSession *ranks, Error *error)
{
    if (!probes->probes)
        return true;
    gather_read(&probes->gathered, probes->probes, ranks->session.world);
    return dist_agree(ranks->rank > 0 || probe_series_step(&probes->series, &ranks->session, error), error);
}

/* All ranks have already checked the step with world_is_valid; another check by a single rank is not
   collective. */
static bool dist_probes_frame(DistProbes *probes, const RankSession *ranks, Error *error)
{
    return !probes->probes ||
           dist_agree(ranks->rank > 0 || probe_series_frame(&probes->series, &ranks->session, error), error);
}

/* Closes the table, keeping its figures, and draws the plot, also after a broken run. */
static bool dist_probes_end(DistProbes *probes, const RankSession *ranks, const Args *args, Error *error)
{
    bool ok = true;
    if (!probes->probes)
        return true;
    if (ranks->rank == 0)
        ok = probe_series_close(&probes->series, error) &&
             run_probes_draw(&probes->series, &ranks->session, args, error);
    return dist_agree(ok, error);
}

static void dist_probes_free(DistProbes *probes)
{
    probe_series_free(&probes->series);
    gather_free(&probes->gathered);
    probes_destroy(probes->probes);
    probes->probes = NULL;
}

/* Starts summing forces in the world, also for force probes. */
static bool dist_forces_enable(const RankSession *ranks, const Args *args, Error *error)
{
    const Session *session = &ranks->session;
    const bool feels = args->forces || (args->probes && probe_list_has_forces(&session->scene.probes));
    return !feels || world_enable_forces(session->world, error);
}

/* Checks if the file can be written. */
static bool dist_forces_check(const RankSession *ranks, const Args *args, Error *error)
{
    return dist_agree(ranks->rank > 0 || !args->forces || output_check(args->forces, error), error);
}

static bool dist_forces_begin(ForcesLog *log, const RankSession *ranks, const Args *args, bool resumed,
                              Error *error)
{
    const Session *session = &ranks->session;
    const double keep = resumed ? session->info.time : -1;
    return !args->forces ||
           dist_agree(ranks->rank > 0 ||
                          forces_log_open(log, args->forces, session->scene.world.solid_count, keep, error),
                      error);
}

/* Call at the end of a frame, before dist_probes_frame. */
static bool dist_forces_frame(ForcesLog *log, ProbeSeries *probes, RankSession *ranks, const Args *args,
                              Error *error)
{
    Forces forces;
    bool ok = true;
    if (!args->forces)
        return true;
    probe_series_forces(probes, &ranks->session, &forces);
    if (ranks->rank == 0)
        ok = forces_log_add(log, ranks->session.info.time, &forces, error);
    return dist_agree(ok, error);
}

static bool dist_forces_end(ForcesLog *log, Error *error)
{
    return dist_agree(forces_log_close(log, error), error);
}

typedef struct DistRun {
    const Args *args;
    RankSession ranks;
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
    const Session *session = &run->ranks.session;
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
        ok = rank_session_substep(&run->ranks, error) && dist_probes_step(&run->probes, &run->ranks, error);
    while (ok && run->ranks.session.info.within_frame);
    run->step_seconds += (wall_ms() - begin) / 1000;
    return ok && dist_forces_frame(&run->forces, &run->probes.series, &run->ranks, run->args, error) &&
           dist_probes_frame(&run->probes, &run->ranks, error);
}

/* Returns false, on all ranks, if the simulation broke or a file cannot be written. */
static bool simulate(DistRun *run, Progress *progress, Error *error)
{
    const Session *session = &run->ranks.session;
    for (;;) {
        if (!add_snapshot(run, error))
            return false;
        if (session_reached(session, run->args->time) || rank_session_interrupted())
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
                     .stopped = !session_reached(&run->ranks.session, run->args->time)};
}

static bool write_json(const DistRun *run, Error *error)
{
    const Summary summary = summary_of(run);
    if (!run->args->json)
        return true;
    json_t *json = session_json(&run->ranks.session, run->args, &summary);
    json_object_set_new(json, "ranks", json_integer(run->ranks.size));
    const bool written = json_file_write(json, run->args->json, error);
    json_decref(json);
    return written;
}

static int finish(const DistRun *run, Error *error)
{
    const Summary summary = summary_of(run);
    bool ok = true;
    if (run->ranks.rank == 0) {
        session_report(&run->ranks.session, run->args, &summary);
        ok = write_json(run, error);
    }
    if (!dist_agree(ok, error)) {
        rank_session_say(&run->ranks, error->message);
        return EXIT_FAILED;
    }
    return summary.stopped ? EXIT_INTERRUPTED : 0;
}

static int fail(const DistRun *run, const Error *error)
{
    const Summary summary = summary_of(run);
    if (run->ranks.rank == 0) {
        session_fail(&run->ranks.session, run->args, &summary, error);
        snapshot_series_report_left(run->file, run->args->output);
    }
    return EXIT_FAILED;
}

/* ---- start ---- */

/* --resume with an existing file: loads the state at the file's end, written on any count of ranks. */
static bool resume(DistRun *run, Error *error)
{
    WorldState state = {.count = 0};
    Session *session = &run->ranks.session;
    run->file =
        snapshot_resume_parallel(run->args->output, &session->scene, dist_parallel_file(), &state, error);
    if (!run->file)
        return false;
    ranks_spread(&state, &session->scene.world);
    if (!world_load(session->world, &state, error))
        dist_die("%s", error->message);
    world_state_free(&state);
    world_info(session->world, &session->info);
    run->next = floor(session->info.time / run->args->every + 1e-6) + 1;
    if (run->ranks.rank == 0 && !run->args->quiet)
        fprintf(stderr, "%s: goes on from %.4g s, behind %zu snapshot%s\n", run->args->output,
                session->info.time, snapshot_steps(run->file), plural(snapshot_steps(run->file)));
    return true;
}

/* As seen by the first rank. */
static bool is_there(const DistRun *run)
{
    int there = run->ranks.rank == 0 && access(run->args->output, F_OK) == 0;
    MPI_Bcast(&there, 1, MPI_INT, 0, MPI_COMM_WORLD);
    return there;
}

static bool check_files(const DistRun *run, bool goes_on, Error *error)
{
    const Args *args = run->args;
    const bool ok = run->ranks.rank > 0 || !args->json || json_file_check(args->json, error);
    return dist_agree(ok, error) && dist_forces_check(&run->ranks, args, error) &&
           dist_probes_check_table(&run->ranks, args, goes_on, error);
}

static bool begin_file(DistRun *run, bool goes_on, Error *error)
{
    if (goes_on)
        return resume(run, error);
    run->file =
        snapshot_create_parallel(run->args->output, &run->ranks.session.scene, dist_parallel_file(), error);
    return run->file != NULL;
}

static int go(DistRun *run, Error *error)
{
    Progress progress;
    RankSession *ranks = &run->ranks;
    const bool goes_on = run->args->resume && is_there(run);
    const bool asked_well =
        dist_probes_check(ranks, run->args, error) && dist_forces_enable(ranks, run->args, error);
    if (!asked_well || !check_files(run, goes_on, error)) {
        rank_session_say(ranks, error->message);
        return asked_well ? EXIT_FAILED : EXIT_USAGE;
    }
    if (!begin_file(run, goes_on, error))
        return fail(run, error);
    progress_begin(&progress, stderr, "run", run->args->quiet || ranks->rank > 0);
    bool done = dist_forces_begin(&run->forces, ranks, run->args, goes_on, error) &&
                dist_probes_begin(&run->probes, ranks, run->args, goes_on, error) &&
                simulate(run, &progress, error);
    progress_end(&progress);
    Error none = {{0}};
    done &= dist_forces_end(&run->forces, done ? error : &none);
    done &= dist_probes_end(&run->probes, ranks, run->args, done ? error : &none);
    return done ? finish(run, error) : fail(run, error);
}

int dist_run(const Args *args)
{
    static DistRun run; /* a scene is large */
    Error error = {{0}};
    run = (DistRun){.args = args};
    rank_session_begin(&run.ranks);
    int code = check_options(args, &error) ? rank_session_open(&run.ranks, args, "run", &error) : EXIT_USAGE;
    if (code == 0)
        code = go(&run, &error);
    else
        rank_session_say(&run.ranks, error.message);
    snapshot_close(run.file);
    dist_probes_free(&run.probes);
    world_destroy(run.ranks.session.world);
    return code;
}
