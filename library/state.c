/* Saved states and recorded runs. HDF5 is not made for threads: all use is under the library's lock.
 */
#include "slosh/state.h"
#include "app/files/snapshot.h"
#include "app/run/playback/playback.h"
#include "library/library.h"
#include "sim/state.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- save and load ---- */

static bool name_is_right(const char *path, Error *error)
{
    if (!path)
        return error_set(error, "the file's name is NULL");
    return recorded_is_file(path) || error_set(error, "%s: a file of states must be named NAME.h5part", path);
}

struct slosh_record {
    SnapshotWriter *file;
    const slosh_world *world;
};

static bool save(slosh_world *world, const char *path, Error *error)
{
    SnapshotWriter *file = snapshot_create(path, &world->run.scene, error);
    const bool ok = file && snapshot_append(file, world->run.world, error);
    snapshot_close(file);
    return ok;
}

bool slosh_world_save(slosh_world *world, const char *path, slosh_error *error)
{
    Error why = {{0}};
    if (!world)
        return library_refuse(error, "the world is NULL");
    library_lock();
    const bool ok = name_is_right(path, &why) && save(world, path, &why);
    library_unlock();
    return ok || library_fail(error, &why);
}

static bool load(slosh_world *world, const char *path, Error *error)
{
    WorldState state = {.count = 0};
    const bool ok =
        snapshot_load(path, &world->run.scene, &state, error) && world_load(world->run.world, &state, error);
    world_state_free(&state);
    return ok;
}

bool slosh_world_load(slosh_world *world, const char *path, slosh_error *error)
{
    Error why = {{0}};
    if (!world)
        return library_refuse(error, "the world is NULL");
    library_lock();
    const bool ok = name_is_right(path, &why) && load(world, path, &why);
    library_unlock();
    if (ok)
        world->run.watch.resumed = true;
    library_changed(world);
    return ok || library_fail(error, &why);
}

slosh_record *slosh_record_create(slosh_world *world, const char *path, slosh_error *error)
{
    Error why = {"out of memory"};
    if (!world)
        return library_refuse(error, "the world is NULL"), NULL;
    slosh_record *record = calloc(1, sizeof *record);
    library_lock();
    if (record && name_is_right(path, &why))
        record->file = snapshot_create(path, &world->run.scene, &why);
    library_unlock();
    if (record && record->file) {
        record->world = world;
        return record;
    }
    free(record);
    return library_fail(error, &why), NULL;
}

bool slosh_record_add(slosh_record *record, slosh_world *world, slosh_error *error)
{
    Error why = {{0}};
    if (!record || !world)
        return library_refuse(error, "the record or the world is NULL");
    if (world != record->world)
        return library_refuse(error, "the record is of another world");
    library_lock();
    const bool ok = snapshot_append(record->file, world->run.world, &why);
    library_unlock();
    return ok || library_fail(error, &why);
}

void slosh_record_close(slosh_record *record)
{
    if (!record)
        return;
    library_lock();
    snapshot_close(record->file);
    library_unlock();
    free(record);
}

/* ---- recorded runs ---- */

struct slosh_run {
    Recorded recorded;
    StateCopy state;
    bool read;    /* the state is of */
    size_t index; /* this step */
};

slosh_run *slosh_run_open(const char *path, slosh_error *error)
{
    Error why = {"out of memory"};
    slosh_run *run = calloc(1, sizeof *run);
    library_lock();
    const bool ok = run && (path || error_set(&why, "the file's name is NULL")) &&
                    recorded_open(path, NULL, &run->recorded, NULL, &why);
    library_unlock();
    if (ok)
        return run;
    free(run);
    return library_fail(error, &why), NULL;
}

void slosh_run_close(slosh_run *run)
{
    if (!run)
        return;
    library_lock();
    recorded_close(&run->recorded);
    library_unlock();
    state_copy_free(&run->state);
    free(run);
}

size_t slosh_run_count(const slosh_run *run)
{
    return run ? run->recorded.steps : 0;
}

static bool has_step(const slosh_run *run, size_t index, Error *error)
{
    if (!run)
        return error_set(error, "the run is NULL");
    return index < run->recorded.steps ||
           error_set(error, "%s: there is no step %zu; the file has %zu, from 0", run->recorded.path, index,
                     run->recorded.steps);
}

bool slosh_run_time(slosh_run *run, size_t index, double *time, slosh_error *error)
{
    Error why = {{0}};
    library_lock();
    const bool ok = has_step(run, index, &why) && (time || error_set(&why, "the time is NULL")) &&
                    recorded_time(&run->recorded, index, time, &why);
    library_unlock();
    return ok || library_fail(error, &why);
}

/* A column of a file. */
typedef struct RunColumn {
    const char *name, *unit;
    unsigned attribute; /* 0: always there */
    int scalar;         /* -1: none */
    int components;
    size_t skip; /* numbers before the first component, in rows of four */
} RunColumn;

static const RunColumn vectors[] = {
    {"position", "m", 0, -1, 3, 0},          {"velocity", "m/s", PARTICLE_VELOCITY, -1, 3, 0},
    {"volume", "m3", 0, -1, 1, 3},           {"id", "", PARTICLE_ID, -1, 1, 0},
    {"fluid", "", PARTICLE_FLUID, -1, 1, 0},
};

enum { VECTORS = sizeof vectors / sizeof *vectors };

/* Column number `index`; false after the last. */
static bool run_column(const slosh_run *run, size_t index, RunColumn *column)
{
    const unsigned has = run->recorded.attributes;
    for (int i = 0; i < VECTORS; i++)
        if ((vectors[i].attribute & has) == vectors[i].attribute && index-- == 0) {
            *column = vectors[i];
            return true;
        }
    for (int s = 0; s < SCALAR_STATE_COUNT; s++)
        if (has & PARTICLE_SCALAR(s) && s != SCALAR_ID && s != SCALAR_FLUID && index-- == 0) {
            *column =
                (RunColumn){scalar_name((Scalar)s), scalar_unit((Scalar)s), PARTICLE_SCALAR(s), s, 1, 0};
            return true;
        }
    return false;
}

const char *slosh_run_column_name(const slosh_run *run, size_t index)
{
    RunColumn column;
    return run && run_column(run, index, &column) ? column.name : NULL;
}

static bool find_column(const slosh_run *run, const char *name, RunColumn *column, Error *error)
{
    char names[600] = "";
    for (size_t i = 0; run_column(run, i, column); i++) {
        if (name && strcmp(name, column->name) == 0)
            return true;
        snprintf(names + strlen(names), sizeof names - strlen(names), "%s%s", i > 0 ? ", " : "",
                 column->name);
    }
    return error_set(error, "%s: no such column; %s has %s", name ? name : "NULL", run->recorded.path, names);
}

static bool read_step(slosh_run *run, size_t index, Error *error)
{
    if (run->read && run->index == index)
        return true;
    run->read = recorded_read(&run->recorded, index, run->recorded.attributes, &run->state, error);
    run->index = index;
    return run->read;
}

static const void *data_of(const ParticleArrays *arrays, const RunColumn *kind)
{
    if (kind->scalar >= 0)
        return arrays->scalar[kind->scalar];
    if (kind->attribute == PARTICLE_ID)
        return arrays->id;
    if (kind->attribute == PARTICLE_FLUID)
        return arrays->fluid;
    return kind->attribute == PARTICLE_VELOCITY ? arrays->velocity : arrays->position + kind->skip;
}

static void fill(const slosh_run *run, const RunColumn *kind, slosh_column *column)
{
    const bool whole = kind->attribute == PARTICLE_ID || kind->attribute == PARTICLE_FLUID;
    column->data = data_of(&run->state.arrays, kind);
    column->count = run->state.state.count;
    column->unit = kind->unit;
    column->components = kind->components;
    column->stride = kind->scalar < 0 && !whole ? 4 * sizeof(float) : sizeof(float);
    column->type = whole ? SLOSH_UINT32 : SLOSH_FLOAT32;
}

bool slosh_run_column(slosh_run *run, size_t index, const char *name, slosh_column *column,
                      slosh_error *error)
{
    Error why = {{0}};
    RunColumn kind;
    if (!column || column->size < sizeof *column)
        return library_refuse(error, "the column is NULL, or its member size is not sizeof(slosh_column)");
    library_lock();
    const bool ok =
        has_step(run, index, &why) && find_column(run, name, &kind, &why) && read_step(run, index, &why);
    library_unlock();
    if (!ok)
        return library_fail(error, &why);
    fill(run, &kind, column);
    return true;
}
