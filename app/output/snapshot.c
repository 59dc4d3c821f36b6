/* After: H5Part, Howison and others, "H5hut: a high-performance I/O library for particle-based simulations",
   2010, and the layout accepted by ParaView's reader. */
#include "app/output/snapshot.h"

#include "app/base/hdf5_error.h"
#include "app/base/output_lock.h"
#include "app/output/snapshot_parts.h"
#include "app/output/snapshot_share.h"
#include "sim/matter/flow.h"
#include "sim/world/method.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { DIRECTORY_K = 128, DIRECTORY_NAME_BYTES = 16 * 2 * DIRECTORY_K };

struct Snapshot {
    const SnapshotShare *share; /* NULL: a single process writes */
    Output output;          /* of the first process when shared; the following processes use `path` only */
    OutputLock lock, older; /* on the file; on the file to replace */
    hid_t file;
    ColumnRows saved; /* columns of the worlds' states */
    bool emits;       /* births are written; otherwise all particles began at time 0 */
    size_t steps;
    double time; /* of the last written step */
    bool failed;
    SnapshotStep buffer; /* of the last world; arrays of `capacity` particles */
    size_t capacity;
    float *position, *velocity; /* 4 values per particle, as from world_read */
    uint32_t *fluid;
};

hid_t snapshot_access(void)
{
    hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    if (access >= 0)
        H5Pset_file_locking(access, false, true);
    return access;
}

/* ---- sharing processes ---- */

/* True for the process that handles the file's name, locks and disk space. */
static bool is_first(const Snapshot *snapshot)
{
    return !snapshot->share || snapshot->share->first;
}

static bool agree(const Snapshot *snapshot, bool ok, Error *error)
{
    return snapshot->share ? snapshot->share->agree(ok, error) : ok;
}

static hid_t access_of(const Snapshot *snapshot)
{
    return snapshot->share ? snapshot->share->access() : snapshot_access();
}

/* The range of the process' particles among the particles of all processes. */
static Extent extent_of(const Snapshot *snapshot, size_t own)
{
    Extent extent = {0, own, own, H5P_DEFAULT};
    if (snapshot->share)
        extent.begin = snapshot->share->before(own, &extent.all);
    return extent;
}

/* ---- the file ---- */

/* Creates the file; the directory has room for 256 names (twice K) of 16 bytes before growing. */
static hid_t create_file(const Snapshot *snapshot, const char *path)
{
    hid_t creation = H5Pcreate(H5P_FILE_CREATE);
    hid_t access = access_of(snapshot);
    H5Pset_local_heap_size_hint(creation, DIRECTORY_NAME_BYTES);
    H5Pset_sym_k(creation, 0, DIRECTORY_K);
    H5Pset_istore_k(creation, 4); /* a field has one chunk or a few: the default reserves room for 64 */
    hid_t file = H5Fcreate(path, H5F_ACC_TRUNC, creation, access);
    H5Pclose(access);
    H5Pclose(creation);
    return file;
}

static bool begin(Snapshot *snapshot, const char *path, const Scene *scene, Error *error)
{
    Output *output = &snapshot->output;
    char temp[sizeof output->temp];
    const bool named = !is_first(snapshot) || (output_begin(output, path, error) &&
                                               output_lock(&snapshot->older, output->path, error));
    if (!agree(snapshot, named, error))
        return false;
    memcpy(temp, output->temp, sizeof temp);
    if (snapshot->share)
        snapshot->share->tell(temp, sizeof temp);
    snprintf(output->path, sizeof output->path, "%s", path);
    hdf5_listen();
    snapshot->file = create_file(snapshot, temp);
    bool begun = (snapshot->file >= 0 && snapshot_write_root(snapshot->file, scene)) ||
                 hdf5_fail(error, path, "cannot be written");
    begun = begun && (!is_first(snapshot) || output_lock(&snapshot->lock, temp, error));
    return agree(snapshot, begun, error);
}

/* Makes a zeroed snapshot, for all processes or for none. */
static Snapshot *made(const char *path, const SnapshotShare *share, Error *error)
{
    Snapshot *snapshot = calloc(1, sizeof *snapshot);
    if (!snapshot)
        error_set(error, "%s: out of memory", path);
    const bool all = share ? share->agree(snapshot != NULL, error) : true;
    if (!all) {
        free(snapshot);
        return NULL;
    }
    if (snapshot)
        snapshot->share = share;
    return snapshot;
}

Snapshot *snapshot_create_shared(const char *path, const Scene *scene, const SnapshotShare *share,
                                 Error *error)
{
    Snapshot *snapshot = made(path, share, error);
    if (!snapshot)
        return NULL;
    snapshot->time = -1;
    snapshot->file = -1;
    snapshot->saved = columns_saved(&scene->world);
    snapshot->emits = flow_emits(&scene->world);
    if (!begin(snapshot, path, scene, error)) {
        snapshot_close(snapshot);
        snapshot = NULL;
    }
    return snapshot;
}

Snapshot *snapshot_create(const char *path, const Scene *scene, Error *error)
{
    return snapshot_create_shared(path, scene, NULL, error);
}

bool snapshot_note_hand(Snapshot *snapshot, const char *mark, Error *error)
{
    return !*mark ||
           snapshot_write_texts(snapshot->file, SNAPSHOT_HAND, SNAPSHOT_SCALAR, strlen(mark) + 1, mark) ||
           hdf5_fail(error, snapshot->output.path, "cannot be written");
}

Snapshot *snapshot_continue(const char *path, const WorldDef *world, size_t steps, OutputLock *lock,
                            const SnapshotShare *share, Error *error)
{
    Snapshot *snapshot = made(path, share, error);
    char name[32];
    if (!snapshot)
        return NULL;
    const hid_t access = access_of(snapshot);
    snapshot->lock = *lock;
    lock->state = OUTPUT_UNLOCKED;
    snapshot->saved = columns_saved(world);
    snapshot->emits = flow_emits(world);
    snapshot->steps = steps;
    snapshot->time = -1;
    snprintf(snapshot->output.path, sizeof snapshot->output.path, "%s", path);
    snapshot->file = H5Fopen(path, H5F_ACC_RDWR, access);
    H5Pclose(access);
    snapshot_group_name(steps, name);
    const bool opened = (snapshot->file >= 0 && (H5Lexists(snapshot->file, name, H5P_DEFAULT) <= 0 ||
                                                 H5Ldelete(snapshot->file, name, H5P_DEFAULT) >= 0)) ||
                        hdf5_fail(error, path, "cannot be written");
    if (!agree(snapshot, opened, error)) {
        snapshot_close(snapshot);
        return NULL;
    }
    return snapshot;
}

static void free_buffers(Snapshot *snapshot)
{
    snapshot_step_free(&snapshot->buffer);
    free(snapshot->position);
    free(snapshot->velocity);
    free(snapshot->fluid);
    snapshot->position = snapshot->velocity = NULL;
    snapshot->fluid = NULL;
    snapshot->capacity = 0;
}

void snapshot_close(Snapshot *snapshot)
{
    if (!snapshot)
        return;
    if (snapshot->file >= 0)
        H5Fclose(snapshot->file);
    if (snapshot->steps > 0 && is_first(snapshot))
        snapshot_trim(snapshot->output.path);
    output_discard(&snapshot->output);
    output_unlock(&snapshot->older);
    output_unlock(&snapshot->lock);
    free_buffers(snapshot);
    free(snapshot);
}

double snapshot_time(const Snapshot *snapshot)
{
    return snapshot->time;
}

size_t snapshot_steps(const Snapshot *snapshot)
{
    return snapshot->steps;
}

/* ---- one step ---- */

/* Reserves disk space for one more step, or fails while the file is still intact: HDF5 writes directory and
   data in an order that a full disk would break. */
static bool reserve(const Snapshot *snapshot, size_t bytes, Error *error)
{
    const Output *output = &snapshot->output;
    const int reason = snapshot_take_room(snapshot->file, snapshot->steps > 0 ? output->path : output->temp,
                                          snapshot->share, bytes);
    return reason == 0 || error_set(error, "%s: cannot be written: %s; step %zu needs up to %zu KiB",
                                    output->path, strerror(reason), snapshot->steps, bytes >> 10);
}

static bool broken(const Snapshot *snapshot, Error *error)
{
    hdf5_fail(error, snapshot->output.path, "cannot be written");
    if (snapshot->share)
        snapshot->share->end(error);
    return false;
}

bool snapshot_append_step(Snapshot *snapshot, const SnapshotStep *step, Error *error)
{
    if (snapshot->failed)
        return error_set(error, "%s: takes no more steps after a failed one", snapshot->output.path);
    snapshot->failed = true;
    Extent extent = extent_of(snapshot, step->count);
    if (!agree(snapshot, reserve(snapshot, snapshot_step_bytes(step, extent.all), error), error))
        return false;
    if (snapshot->share)
        extent.transfer = snapshot->share->transfer();
    const bool written = snapshot_write_step(snapshot->file, snapshot->steps, step, &extent);
    if (extent.transfer != H5P_DEFAULT)
        H5Pclose(extent.transfer);
    if (!written)
        return broken(snapshot, error);
    if (snapshot->steps == 0 &&
        !agree(snapshot,
               !is_first(snapshot) || output_lock_commit(&snapshot->older, &snapshot->output, error), error))
        return false;
    snapshot->steps++;
    snapshot->time = step->time;
    snapshot->failed = false;
    return true;
}

/* ---- from a world ---- */

static bool grow_buffers(Snapshot *snapshot, size_t count, Error *error)
{
    if (count <= snapshot->capacity && snapshot->capacity > 0)
        return true;
    free_buffers(snapshot);
    count = count > 0 ? count : 1; /* so that a first step without particles has all datasets */
    snapshot->position = malloc(4 * count * sizeof(float));
    snapshot->velocity = malloc(4 * count * sizeof(float));
    snapshot->fluid = malloc(count * sizeof(uint32_t));
    if (!snapshot->position || !snapshot->velocity || !snapshot->fluid ||
        !snapshot_step_allocate(&snapshot->buffer, count) ||
        !snapshot_step_own(&snapshot->buffer, &snapshot->saved) ||
        (snapshot->emits && !snapshot_step_born(&snapshot->buffer))) {
        free_buffers(snapshot);
        return error_set(error, "%s: out of memory for %zu particles", snapshot->output.path, count);
    }
    snapshot->capacity = count;
    return true;
}

static bool read_world(Snapshot *snapshot, World *world, const WorldInfo *info)
{
    SnapshotStep *step = &snapshot->buffer;
    step->time = info->time;
    step->step = info->step;
    step->box = info->box;
    memcpy(step->gravity, info->gravity, sizeof step->gravity);
    step->count = snapshot->share ? snapshot->share->held() : info->count;
    world_save_numbers(world, &step->restart);
    ParticleArrays arrays = {
        .position = snapshot->position,
        .velocity = snapshot->velocity,
        .scalar = {[SCALAR_DENSITY] = step->density,
                   [SCALAR_PRESSURE] = step->pressure,
                   [SCALAR_COMPRESSION] = step->compression,
                   [SCALAR_BORN] = step->born},
        .fluid = snapshot->fluid,
        .whole_id = (ParticleId *)step->id, /* ids are less than 2^63 */
    };
    for (int k = 0; k < step->own_count; k++)
        arrays.own[step->own[k].place] = step->own[k].values;
    const bool read = world_read(world, &arrays);
    for (size_t i = 0; i < step->count; i++) {
        for (int axis = 0; axis < 3; axis++) {
            step->position[axis][i] = snapshot->position[4 * i + axis];
            step->velocity[axis][i] = snapshot->velocity[4 * i + axis];
        }
        step->fluid[i] = (int32_t)snapshot->fluid[i];
    }
    return read;
}

bool snapshot_append(Snapshot *snapshot, World *world, Error *error)
{
    WorldInfo info;
    world_info(world, &info);
    const size_t count = snapshot->share ? snapshot->share->held() : info.count;
    const bool read = grow_buffers(snapshot, count, error) &&
                      (read_world(snapshot, world, &info) ||
                       error_set(error, "%s: no memory to read %zu particles", snapshot->output.path, count));
    return agree(snapshot, read, error) && snapshot_append_step(snapshot, &snapshot->buffer, error);
}
