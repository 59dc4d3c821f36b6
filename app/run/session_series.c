#include "app/run/session.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

static bool no_memory(Error *error)
{
    return error_set(error, "no memory for the probes; use fewer of them, or a larger spacing");
}

/* Reads the mean forces of the last step, and adds them to the sum for later callers. */
static const Forces *feel_now(ProbeSeries *series, const Session *session, Forces *now)
{
    if (!series->feels)
        return NULL;
    world_forces(session->world, now);
    forces_add_mean(&series->felt, now);
    return now;
}

static bool read_now(ProbeSeries *series, const Session *session, Error *error)
{
    Forces now;
    if (!series->given && !cloud_read(&series->cloud, session->world))
        return no_memory(error);
    probes_read(series->probes, series->given ? series->given : &series->cloud,
                feel_now(series, session, &now), series->value);
    series->troubles = session->info.trouble.count;
    return probe_table_add(&series->table, session->info.time, series->value) || no_memory(error);
}

/* Reports facts on the opened table: waits for a GPU, missing rows. */
static void tell(const ProbeSeries *series, const Session *session, const char *path, bool resumed,
                 bool there)
{
    const double from = series->table.last, now = session->info.time;
    if (world_on_gpu(&session->scene.world))
        fprintf(stderr, "%s: probes read all particles back after each step, for which backend %s waits\n",
                path, session->scene.world.backend);
    if (resumed && !there)
        fprintf(stderr, "%s: there is no such table to go on with; it begins at t = %.4g s\n", path, now);
    else if (resumed && from < now * (1 - 1e-9))
        fprintf(stderr, "%s: the table ends at t = %.4g s; rows from there to %.4g s are missing\n", path,
                from < 0 ? 0 : from, now);
}

bool probe_series_begin(ProbeSeries *series, Session *session, const char *path, bool resumed, Error *error)
{
    if (!path)
        return true;
    const bool there = access(path, F_OK) == 0;
    series->feels = probe_list_has_forces(&session->scene.probes);
    series->probes = probes_create(&session->scene.probes, &session->scene.world);
    series->value =
        series->probes ? malloc(((size_t)probes_columns(series->probes) + 1) * sizeof(float)) : NULL;
    if (!series->value)
        return no_memory(error);
    if (!probe_table_open(&series->table, path, series->probes, resumed ? session->info.time : -1, error))
        return false;
    tell(series, session, path, resumed, there);
    series->troubles = session->info.trouble.count;
    return resumed || (read_now(series, session, error) && probe_table_write(&series->table, error));
}

/* Drops the readings of a frame that the world has taken back. */
static void drop(ProbeSeries *series)
{
    probe_table_drop(&series->table);
    series->felt = (Forces){0};
}

bool probe_series_step(ProbeSeries *series, const Session *session, Error *error)
{
    if (!series->probes)
        return true;
    if (session->info.trouble.count == series->troubles)
        return read_now(series, session, error);
    series->troubles = session->info.trouble.count;
    drop(series);
    return true;
}

void probe_series_forces(ProbeSeries *series, Session *session, Forces *forces)
{
    if (!series->feels) {
        world_forces(session->world, forces);
        return;
    }
    if (!world_is_valid(session->world))
        drop(series);
    *forces = series->felt;
    forces_mean(forces);
    series->felt = (Forces){0};
}

bool probe_series_frame(ProbeSeries *series, const Session *session, Error *error)
{
    if (!series->probes)
        return true;
    if (!world_is_valid(session->world)) /* the next step returns to the begin of this frame */
        drop(series);
    return probe_table_write(&series->table, error);
}

bool probe_series_close(ProbeSeries *series, Error *error)
{
    return probe_table_close(&series->table, error);
}

void probe_series_free(ProbeSeries *series)
{
    probe_table_free(&series->table);
    cloud_free(&series->cloud);
    free(series->value);
    probes_destroy(series->probes);
    *series = (ProbeSeries){.probes = NULL};
}

void snapshot_series_resume(SnapshotSeries *series, const Session *session)
{
    series->next = fmax(series->next, floor(session->info.time / series->every + 1e-6)) + 1;
}

bool snapshot_series_add(SnapshotSeries *series, const Session *session, Error *error)
{
    if (!series->file || !session_reached(session, series->next * series->every))
        return true;
    if (!snapshot_append(series->file, session->world, error))
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
