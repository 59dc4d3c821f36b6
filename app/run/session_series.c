#include "app/run/session.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

static bool no_memory(Error *error)
{
    return error_set(error, "no memory for the probes; use fewer of them, or a larger spacing");
}

static bool read_now(ProbeSeries *series, Session *session, Error *error)
{
    Forces now;
    Run *run = &session->run;
    bool read = run_read_probes(run, &now);
    if (run->probes.wants_forces)
        forces_add_mean(&series->forces, &now);
    series->troubles = run->info.trouble.count;
    if (read && run_is_first(run))
        read = probe_table_add(&series->table, run->info.time, run->probes.value);
    return run_agree(run, read || no_memory(error), error);
}

/* Reports facts on the opened table: waits for a GPU, missing rows. */
static void tell(const ProbeSeries *series, const Session *session, const char *path, bool resumed,
                 bool there)
{
    const double from = series->table.last, now = session->run.info.time;
    if (world_on_gpu(&session->run.scene.world))
        fprintf(stderr, "%s: probes read all particles back after each step, for which backend %s waits\n",
                path, session->run.scene.world.backend);
    if (resumed && !there)
        fprintf(stderr, "%s: there is no such table to go on with; it begins at t = %.4g s\n", path, now);
    else if (resumed && from < now * (1 - 1e-9))
        fprintf(stderr, "%s: the table ends at t = %.4g s; rows from there to %.4g s are missing\n", path,
                from < 0 ? 0 : from, now);
}

static bool open_table(ProbeSeries *series, const Session *session, const char *path, bool resumed,
                       Error *error)
{
    const Run *run = &session->run;
    const bool there = access(path, F_OK) == 0;
    if (!run_is_first(run))
        return true;
    if (!probe_table_open(&series->table, path, run->probes.probes, resumed ? run->info.time : -1, error))
        return false;
    tell(series, session, path, resumed, there);
    return true;
}

static bool write_rows(ProbeSeries *series, const Session *session, Error *error)
{
    const bool first = run_is_first(&session->run);
    return run_agree(&session->run, !first || probe_table_write(&series->table, error), error);
}

bool probe_series_begin(ProbeSeries *series, Session *session, const char *path, bool resumed, Error *error)
{
    Run *run = &session->run;
    if (!path)
        return true;
    const bool open =
        (run_open_probes(run) || no_memory(error)) && open_table(series, session, path, resumed, error);
    series->troubles = run->info.trouble.count;
    return run_agree(run, open, error) &&
           (resumed || (read_now(series, session, error) && write_rows(series, session, error)));
}

/* Drops the readings of a frame that the world has taken back. */
static void drop(ProbeSeries *series)
{
    probe_table_drop(&series->table);
    series->forces = (Forces){0};
}

bool probe_series_step(ProbeSeries *series, Session *session, Error *error)
{
    if (!session->run.probes.probes)
        return true;
    if (session->run.info.trouble.count == series->troubles)
        return read_now(series, session, error);
    series->troubles = session->run.info.trouble.count;
    drop(series);
    return true;
}

void probe_series_forces(ProbeSeries *series, Session *session, Forces *forces)
{
    if (!session->run.probes.wants_forces) {
        world_forces(session->run.world, forces);
        return;
    }
    if (!world_is_valid(session->run.world))
        drop(series);
    *forces = series->forces;
    forces_mean(forces);
    series->forces = (Forces){0};
}

bool probe_series_frame(ProbeSeries *series, const Session *session, Error *error)
{
    if (!session->run.probes.probes)
        return true;
    if (!world_is_valid(session->run.world)) /* the next step returns to the begin of this frame */
        drop(series);
    return write_rows(series, session, error);
}

bool probe_series_close(ProbeSeries *series, Error *error)
{
    return probe_table_close(&series->table, error);
}

void probe_series_free(ProbeSeries *series)
{
    probe_table_free(&series->table);
    *series = (ProbeSeries){.troubles = 0};
}

void snapshot_series_resume(SnapshotSeries *series, const Session *session)
{
    series->next = fmax(series->next, floor(session->run.info.time / series->every + 1e-6)) + 1;
}

bool snapshot_series_add(SnapshotSeries *series, const Session *session, Error *error)
{
    if (!series->file || !session_reached(session, series->next * series->every))
        return true;
    if (!snapshot_append(series->file, session->run.world, error))
        return false;
    snapshot_series_resume(series, session);
    return true;
}

void snapshot_series_report_left(const SnapshotWriter *file, const char *path)
{
    if (file && snapshot_steps(file) > 0)
        fprintf(stderr, "%s: holds the %zu whole snapshot%s before that\n", path, snapshot_steps(file),
                plural(snapshot_steps(file)));
}

bool snapshot_series_check_name(const char *path, Error *error)
{
    const char *extension = strrchr(path, '.');
    return (extension && strcasecmp(extension, ".h5part") == 0) ||
           error_set(error, "'%s' is no name for snapshots; name a FILE.h5part", path);
}
