#define _GNU_SOURCE /* fallocate */
/* Disk space for a file of snapshots, reserved before a step is written. */
#include "app/base/file.h"
#include "app/files/snapshot.h"
#include "app/files/snapshot_private.h"
#include "app/scene/scene.h"
#include "sim/base/base.h"
#include "sim/flow/flow.h"
#include "sim/step/method.h"
#include "sim/step/world.h"

#include <errno.h>
#include <fcntl.h>
#include <libgen.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

/* Size of a step beside its values: group, headers, directory (measured: 18 KiB), with a margin. */
enum { STEP_OVERHEAD_BYTES = 64 << 10 };

/* Greatest size of a step with `count` particles of all processes. */
static size_t snapshot_step_bytes(const SnapshotStep *step, size_t count)
{
    size_t bytes = ((size_t)step->own_count + (step->born != NULL)) * sizeof(float);
#define X(name, type, field) bytes += sizeof(type);
    SNAPSHOT_FIELDS(X)
#undef X
    return STEP_OVERHEAD_BYTES + bytes * count + bytes * count / 256; /* last term: trees of chunks */
}

/* The file's descriptor for system calls, -1 on failure; *own: the caller closes. HDF5 has no descriptor for
   a shared file. */
static int system_file(hid_t file, const char *path, const SnapshotParallel *share, bool *own)
{
    int *number = NULL;
    *own = share;
    if (*own)
        return open(path, O_WRONLY);
    return H5Fget_vfd_handle(file, H5P_DEFAULT, (void **)&number) < 0 ? -1 : *number;
}

/* Returns 0, or the errno if the process' limit forbids the file to grow from `size` by `bytes`. */
static int over_limit(off_t size, size_t bytes)
{
    struct rlimit limit;
    return getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY &&
                   (rlim_t)size + bytes > limit.rlim_cur
               ? EFBIG
               : 0;
}

/* Reserves the space on the disk; returns 0 or errno. */
static int take_room(int file, off_t size, size_t bytes)
{
    const bool full = fallocate(file, FALLOC_FL_KEEP_SIZE, size, (off_t)bytes) != 0 &&
                      (errno == ENOSPC || errno == EFBIG || errno == EDQUOT);
    return full ? errno : 0;
}

/* Reserves `bytes` after the end of the file, whose present name is `path`. Returns 0, or an errno: from the
   process that reserves (the first), or from a limit of this process. `share`: NULL for a single process;
   otherwise collective. */
static int snapshot_reserve_space(hid_t file, const char *path, const SnapshotParallel *share, size_t bytes)
{
    const bool first = !share || share->first;
    bool own = false;
    struct stat status = {.st_size = 0};
    const int number = first ? system_file(file, path, share, &own) : -1;
    int reason = first && (number < 0 || fstat(number, &status) != 0) ? errno : 0;
    if (share)
        share->tell(&status.st_size, sizeof status.st_size);
    if (!reason)
        reason = over_limit(status.st_size, bytes);
    if (!reason && first)
        reason = take_room(number, status.st_size, bytes);
    if (own && number >= 0)
        close(number);
    return reason;
}

/* Releases unused reserved space. */
static void snapshot_trim(const char *path)
{
    struct stat status;
    if (stat(path, &status) == 0 && truncate(path, status.st_size) != 0)
        return; /* harmless: the space stays reserved */
}

/* Writes the attributes and datasets of a file of snapshots. */

enum { CHUNK_VALUES = 1 << 16 };

static bool write_attribute(hid_t at, const char *name, hid_t type, hid_t space, const void *value)
{
    hid_t attribute = H5Acreate2(at, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    bool written = attribute >= 0 && H5Awrite(attribute, type, value) >= 0;
    return (attribute < 0 || H5Aclose(attribute) >= 0) && written;
}

/* Write an attribute of `count` values; of `count` strings of `stride` bytes each. */
static bool snapshot_write_values(hid_t at, const char *name, hid_t type, size_t count, const void *values)
{
    hsize_t size = count;
    hid_t space = count == SNAPSHOT_SCALAR ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &size, NULL);
    bool written = space >= 0 && write_attribute(at, name, type, space, values);
    if (space >= 0)
        H5Sclose(space);
    return written;
}

static bool write_doubles(hid_t at, const char *name, size_t count, const double *values)
{
    return snapshot_write_values(at, name, H5T_IEEE_F64LE, count, values);
}

static bool snapshot_write_texts(hid_t at, const char *name, size_t count, size_t stride, const char *texts)
{
    hid_t type = H5Tcopy(H5T_C_S1);
    bool written = type >= 0 && H5Tset_size(type, stride) >= 0 && H5Tset_cset(type, H5T_CSET_UTF8) >= 0 &&
                   snapshot_write_values(at, name, type, count, texts);
    if (type >= 0)
        H5Tclose(type);
    return written;
}

static bool write_settings(hid_t file, const Scene *scene)
{
    char *text = scene_print_text(scene);
    const bool written =
        text && snapshot_write_texts(file, SNAPSHOT_SETTINGS, SNAPSHOT_SCALAR, strlen(text) + 1, text);
    free(text);
    return written;
}

/* Writes the folder of the scene file; none if the scene was never in a file, or the folder is gone. */
static bool write_folder(hid_t file, const Scene *scene)
{
    char copy[sizeof scene->path];
    snprintf(copy, sizeof copy, "%s", scene->path);
    char *folder = realpath(dirname(copy), NULL);
    const bool written =
        !folder || snapshot_write_texts(file, SNAPSHOT_FOLDER, SNAPSHOT_SCALAR, strlen(folder) + 1, folder);
    free(folder);
    return written;
}

/* Datasets not listed have no unit: numbers and fractions. */
static const char units[] = "TimeValue = s\nx = m\ny = m\nz = m\nvelocity_0 = m/s\nvelocity_1 = m/s\n"
                            "velocity_2 = m/s\ndensity = kg/m3\npressure = Pa\n";

/* Writes the root's attributes for the scene. */
static bool snapshot_write_root(hid_t file, const Scene *scene)
{
    const WorldDef *def = &scene->world;
    char names[FLUIDS_MAX][NAME_SIZE] = {{0}};
    double densities[FLUIDS_MAX] = {0}, colors[FLUIDS_MAX][3];
    double support_radius = def->support * def->spacing;
    size_t count = (size_t)def->fluid_count;
    for (size_t i = 0; i < count; i++) {
        snprintf(names[i], NAME_SIZE, "%s", def->fluids[i].name);
        densities[i] = def->fluids[i].density;
        for (int k = 0; k < 3; k++)
            colors[i][k] = linear_to_srgb(def->fluids[i].color[k]);
    }
    return snapshot_write_texts(file, "title", SNAPSHOT_SCALAR, sizeof scene->title, scene->title) &&
           write_settings(file, scene) && write_folder(file, scene) &&
           snapshot_write_texts(file, SNAPSHOT_UNITS, SNAPSHOT_SCALAR, sizeof units, units) &&
           snapshot_write_texts(file, "slosh_version", SNAPSHOT_SCALAR, sizeof SLOSH_VERSION,
                                SLOSH_VERSION) &&
           snapshot_write_texts(file, "method", SNAPSHOT_SCALAR, NAME_SIZE, def->method) &&
           write_doubles(file, "spacing", SNAPSHOT_SCALAR, &def->spacing) &&
           write_doubles(file, "support_radius", SNAPSHOT_SCALAR, &support_radius) &&
           write_doubles(file, "box_size", 3, def->box_size) &&
           snapshot_write_texts(file, "fluid_names", count, NAME_SIZE, names[0]) &&
           write_doubles(file, "fluid_densities", count, densities) &&
           write_doubles(file, SNAPSHOT_COLORS, 3 * count, colors[0]);
}

/* Shuffled bytes and fastest gzip; a field without particles cannot be chunked. */
static hid_t field_layout(size_t count)
{
    hsize_t chunk = count < CHUNK_VALUES ? count : CHUNK_VALUES;
    hid_t layout = H5Pcreate(H5P_DATASET_CREATE);
    if (layout >= 0 && count > 0) {
        H5Pset_chunk(layout, 1, &chunk);
        H5Pset_shuffle(layout);
        H5Pset_deflate(layout, 1);
    }
    return layout;
}

/* Selects the process' own part of a dataset. */
static bool choose(hid_t space, hid_t memory, const SnapshotExtent *extent)
{
    const hsize_t begin = extent->begin, own = extent->own;
    return own == 0 ? H5Sselect_none(space) >= 0 && H5Sselect_none(memory) >= 0
                    : H5Sselect_hyperslab(space, H5S_SELECT_SET, &begin, NULL, &own, NULL) >= 0;
}

static bool write_field(hid_t group, const char *name, hid_t type, const SnapshotExtent *extent,
                        const void *values)
{
    const hsize_t all = extent->all, own = extent->own;
    hid_t space = H5Screate_simple(1, &all, NULL), memory = H5Screate_simple(1, &own, NULL);
    hid_t layout = field_layout(extent->all);
    hid_t set = H5Dcreate2(group, name, type, space, H5P_DEFAULT, layout, H5P_DEFAULT);
    bool written = set >= 0 && choose(space, memory, extent) &&
                   (extent->all == 0 || H5Dwrite(set, type, memory, space, extent->transfer, values) >= 0);
    written = (set < 0 || H5Dclose(set) >= 0) && written;
    H5Pclose(layout);
    H5Sclose(memory);
    H5Sclose(space);
    return written;
}

static bool write_fields(hid_t group, const SnapshotStep *step, const SnapshotExtent *extent)
{
    bool written = true;
#define X(name, count, values)                                                                               \
    written = written && write_doubles(group, name, count == 1 ? SNAPSHOT_SCALAR : count, values);
    SNAPSHOT_ATTRIBUTES(X)
#undef X
#define X(name, type, field)                                                                                 \
    written = written && write_field(group, name, SNAPSHOT_TYPE(step->field), extent, step->field);
    SNAPSHOT_FIELDS(X)
#undef X
    for (int k = 0; k < step->own_count; k++)
        written =
            written && write_field(group, step->own[k].name, H5T_IEEE_F32LE, extent, step->own[k].values);
    if (step->born)
        written = written && write_field(group, scalar_name(SCALAR_BORN), H5T_IEEE_F32LE, extent, step->born);
    written =
        written && write_doubles(group, SNAPSHOT_RESTART, WORLD_NUMBERS, (const double *)&step->restart);
    return written &&
           snapshot_write_values(group, SNAPSHOT_STEP_NUMBER, H5T_STD_U64LE, SNAPSHOT_SCALAR, &step->step);
}

/* A program may be killed between any two writes to the disk. So the step is built as an unlinked group,
   synced to the disk, marked as complete, and only then named. The directory has room for the name without
   growing, so that the last flush overwrites a few bytes in place. Only when the directory must grow, once in
   128 steps, four writes remain during which a kill makes the file unreadable. */
static bool snapshot_write_step(hid_t file, size_t number, const SnapshotStep *step,
                                const SnapshotExtent *extent)
{
    const int32_t complete = 1;
    char name[32];
    snapshot_group_name(number, name);
    hid_t group = H5Gcreate_anon(file, H5P_DEFAULT, H5P_DEFAULT);
    bool written =
        group >= 0 && write_fields(group, step, extent) && H5Fflush(file, H5F_SCOPE_LOCAL) >= 0 &&
        snapshot_write_values(group, SNAPSHOT_COMPLETE, H5T_STD_I32LE, SNAPSHOT_SCALAR, &complete) &&
        H5Fflush(file, H5F_SCOPE_LOCAL) >= 0 && H5Olink(group, file, name, H5P_DEFAULT, H5P_DEFAULT) >= 0;
    written = (group < 0 || H5Gclose(group) >= 0) && written;
    return written && H5Fflush(file, H5F_SCOPE_LOCAL) >= 0;
}

/* After: H5Part, Howison and others, "H5hut: a high-performance I/O library for particle-based simulations",
   2010, and the layout accepted by ParaView's reader. */

enum { DIRECTORY_K = 128, DIRECTORY_NAME_BYTES = 16 * 2 * DIRECTORY_K };

struct SnapshotWriter {
    const SnapshotParallel *share; /* NULL: a single process writes */
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

/* ---- sharing processes ---- */

/* True for the process that handles the file's name, locks and disk space. */
static bool is_first(const SnapshotWriter *snapshot)
{
    return !snapshot->share || snapshot->share->first;
}

static bool agree(const SnapshotWriter *snapshot, bool ok, Error *error)
{
    return snapshot->share ? snapshot->share->agree(ok, error) : ok;
}

static hid_t access_of(const SnapshotWriter *snapshot)
{
    return snapshot->share ? snapshot->share->access() : snapshot_access();
}

/* The range of the process' particles among the particles of all processes. */
static SnapshotExtent extent_of(const SnapshotWriter *snapshot, size_t own)
{
    SnapshotExtent extent = {0, own, own, H5P_DEFAULT};
    if (snapshot->share)
        extent.begin = snapshot->share->before(own, &extent.all);
    return extent;
}

/* ---- the file ---- */

/* Creates the file; the directory has room for 256 names (twice K) of 16 bytes before growing. */
static hid_t create_file(const SnapshotWriter *snapshot, const char *path)
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

static bool begin(SnapshotWriter *snapshot, const char *path, const Scene *scene, Error *error)
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
    hdf5_note_errors();
    snapshot->file = create_file(snapshot, temp);
    bool begun = (snapshot->file >= 0 && snapshot_write_root(snapshot->file, scene)) ||
                 hdf5_fail(error, path, "cannot be written");
    begun = begun && (!is_first(snapshot) || output_lock(&snapshot->lock, temp, error));
    return agree(snapshot, begun, error);
}

/* Makes a zeroed snapshot, for all processes or for none. */
static SnapshotWriter *made(const char *path, const SnapshotParallel *share, Error *error)
{
    SnapshotWriter *snapshot = calloc(1, sizeof *snapshot);
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

SnapshotWriter *snapshot_create_parallel(const char *path, const Scene *scene, const SnapshotParallel *share,
                                         Error *error)
{
    SnapshotWriter *snapshot = made(path, share, error);
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

SnapshotWriter *snapshot_create(const char *path, const Scene *scene, Error *error)
{
    return snapshot_create_parallel(path, scene, NULL, error);
}

bool snapshot_note_motion_source(SnapshotWriter *snapshot, const char *mark, Error *error)
{
    return !*mark ||
           snapshot_write_texts(snapshot->file, SNAPSHOT_MOTION_SOURCE, SNAPSHOT_SCALAR, strlen(mark) + 1,
                                mark) ||
           hdf5_fail(error, snapshot->output.path, "cannot be written");
}

SnapshotWriter *snapshot_continue(const char *path, const WorldDef *world, size_t steps, OutputLock *lock,
                                  const SnapshotParallel *share, Error *error)
{
    SnapshotWriter *snapshot = made(path, share, error);
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

static void free_buffers(SnapshotWriter *snapshot)
{
    snapshot_step_free(&snapshot->buffer);
    free(snapshot->position);
    free(snapshot->velocity);
    free(snapshot->fluid);
    snapshot->position = snapshot->velocity = NULL;
    snapshot->fluid = NULL;
    snapshot->capacity = 0;
}

void snapshot_close(SnapshotWriter *snapshot)
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

double snapshot_time(const SnapshotWriter *snapshot)
{
    return snapshot->time;
}

size_t snapshot_steps(const SnapshotWriter *snapshot)
{
    return snapshot->steps;
}

/* ---- one step ---- */

/* Reserves disk space for one more step, or fails while the file is still intact: HDF5 writes directory and
   data in an order that a full disk would break. */
static bool reserve(const SnapshotWriter *snapshot, size_t bytes, Error *error)
{
    const Output *output = &snapshot->output;
    const int reason = snapshot_reserve_space(
        snapshot->file, snapshot->steps > 0 ? output->path : output->temp, snapshot->share, bytes);
    return reason == 0 || error_set(error, "%s: cannot be written: %s; step %zu needs up to %zu KiB",
                                    output->path, strerror(reason), snapshot->steps, bytes >> 10);
}

static bool broken(const SnapshotWriter *snapshot, Error *error)
{
    hdf5_fail(error, snapshot->output.path, "cannot be written");
    if (snapshot->share)
        snapshot->share->end(error);
    return false;
}

bool snapshot_append_step(SnapshotWriter *snapshot, const SnapshotStep *step, Error *error)
{
    if (snapshot->failed)
        return error_set(error, "%s: takes no more steps after a failed one", snapshot->output.path);
    snapshot->failed = true;
    SnapshotExtent extent = extent_of(snapshot, step->count);
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

static bool grow_buffers(SnapshotWriter *snapshot, size_t count, Error *error)
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
        !snapshot_step_allocate_method_columns(&snapshot->buffer, &snapshot->saved) ||
        (snapshot->emits && !snapshot_step_allocate_births(&snapshot->buffer))) {
        free_buffers(snapshot);
        return error_set(error, "%s: out of memory for %zu particles", snapshot->output.path, count);
    }
    snapshot->capacity = count;
    return true;
}

static bool read_world(SnapshotWriter *snapshot, World *world, const WorldInfo *info)
{
    SnapshotStep *step = &snapshot->buffer;
    step->time = info->time;
    step->step = info->step;
    step->box = info->box;
    memcpy(step->gravity, info->gravity, sizeof step->gravity);
    step->count = world_held(world);
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

bool snapshot_append(SnapshotWriter *snapshot, World *world, Error *error)
{
    WorldInfo info;
    const size_t count = world_held(world);
    world_info(world, &info);
    const bool read = grow_buffers(snapshot, count, error) &&
                      (read_world(snapshot, world, &info) ||
                       error_set(error, "%s: no memory to read %zu particles", snapshot->output.path, count));
    return agree(snapshot, read, error) && snapshot_append_step(snapshot, &snapshot->buffer, error);
}
