#define _GNU_SOURCE /* fallocate */
/* After: H5Part, Howison and others, "H5hut: a high-performance I/O library for particle-based simulations",
   2010, and what ParaView's reader of it accepts. */
#include "app/output/snapshot.h"

#include "app/base/hdf5_error.h"
#include "app/base/output_lock.h"
#include "app/output/snapshot_file.h"
#include "app/scene/keys.h"
#include "sim/base/color.h"
#include "sim/matter/flow.h"

#include <errno.h>
#include <fcntl.h>
#include <libgen.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

enum { DIRECTORY_K = 128, DIRECTORY_NAME_BYTES = 16 * 2 * DIRECTORY_K };

/* What a step takes beside its values: group, headers, directory (measured: 18 KiB), with room to spare. */
enum { STEP_OVERHEAD_BYTES = 64 << 10, CHUNK_VALUES = 1 << 16 };

struct Snapshot {
    Output output;
    OutputLock lock, older; /* on the file; on the one that it will replace */
    hid_t file;
    ColumnRows saved; /* columns of its worlds' states */
    bool emits;       /* births are written: else all began at time 0 */
    size_t steps;
    double time; /* of the last one written */
    bool failed;
    SnapshotStep buffer; /* of the last world, arrays of `capacity` particles */
    size_t capacity;
    float *position, *velocity; /* 4 a particle, as world_read gives them */
    uint32_t *fluid, *id;
};

hid_t snapshot_access(void)
{
    hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    if (access >= 0)
        H5Pset_file_locking(access, false, true);
    return access;
}

/* ---- attributes ---- */

static bool write_attribute(hid_t at, const char *name, hid_t type, hid_t space, const void *value)
{
    hid_t attribute = H5Acreate2(at, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    bool written = attribute >= 0 && H5Awrite(attribute, type, value) >= 0;
    return (attribute < 0 || H5Aclose(attribute) >= 0) && written;
}

enum { SCALAR = 0 };

/* `count` values, or one that is no list. */
static bool write_values(hid_t at, const char *name, hid_t type, size_t count, const void *values)
{
    hsize_t size = count;
    hid_t space = count == SCALAR ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &size, NULL);
    bool written = space >= 0 && write_attribute(at, name, type, space, values);
    if (space >= 0)
        H5Sclose(space);
    return written;
}

static bool write_doubles(hid_t at, const char *name, size_t count, const double *values)
{
    return write_values(at, name, H5T_IEEE_F64LE, count, values);
}

/* `count` strings, `stride` bytes each. */
static bool write_texts(hid_t at, const char *name, size_t count, size_t stride, const char *texts)
{
    hid_t type = H5Tcopy(H5T_C_S1);
    bool written = type >= 0 && H5Tset_size(type, stride) >= 0 && H5Tset_cset(type, H5T_CSET_UTF8) >= 0 &&
                   write_values(at, name, type, count, texts);
    if (type >= 0)
        H5Tclose(type);
    return written;
}

static bool write_settings(hid_t file, const Scene *scene)
{
    char *text = scene_print_text(scene);
    const bool written = text && write_texts(file, SNAPSHOT_SETTINGS, SCALAR, strlen(text) + 1, text);
    free(text);
    return written;
}

/* Of a scene that is not there any more, or was never in a file: none. */
static bool write_folder(hid_t file, const Scene *scene)
{
    char copy[sizeof scene->path];
    snprintf(copy, sizeof copy, "%s", scene->path);
    char *folder = realpath(dirname(copy), NULL);
    const bool written = !folder || write_texts(file, SNAPSHOT_FOLDER, SCALAR, strlen(folder) + 1, folder);
    free(folder);
    return written;
}

/* What the file does not name has none: numbers, and shares. */
static const char units[] = "TimeValue = s\nx = m\ny = m\nz = m\nvelocity_0 = m/s\nvelocity_1 = m/s\n"
                            "velocity_2 = m/s\ndensity = kg/m3\npressure = Pa\n";

static bool write_root(hid_t file, const Scene *scene)
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
    return write_texts(file, "title", SCALAR, sizeof scene->title, scene->title) &&
           write_settings(file, scene) && write_folder(file, scene) &&
           write_texts(file, SNAPSHOT_UNITS, SCALAR, sizeof units, units) &&
           write_texts(file, "slosh_version", SCALAR, sizeof SLOSH_VERSION, SLOSH_VERSION) &&
           write_texts(file, "method", SCALAR, NAME_SIZE, def->method) &&
           write_doubles(file, "spacing", SCALAR, &def->spacing) &&
           write_doubles(file, "support_radius", SCALAR, &support_radius) &&
           write_doubles(file, "box_size", 3, def->box_size) &&
           write_texts(file, "fluid_names", count, NAME_SIZE, names[0]) &&
           write_doubles(file, "fluid_densities", count, densities) &&
           write_doubles(file, SNAPSHOT_COLORS, 3 * count, colors[0]);
}

/* ---- the file ---- */

/* With a directory that has room for 256 names (twice K) of 16 bytes before it must grow. */
static hid_t create_file(const char *path)
{
    hid_t creation = H5Pcreate(H5P_FILE_CREATE);
    hid_t access = snapshot_access();
    H5Pset_local_heap_size_hint(creation, DIRECTORY_NAME_BYTES);
    H5Pset_sym_k(creation, 0, DIRECTORY_K);
    H5Pset_istore_k(creation, 4); /* a field has one chunk or a few: the default keeps room for 64 */
    hid_t file = H5Fcreate(path, H5F_ACC_TRUNC, creation, access);
    H5Pclose(access);
    H5Pclose(creation);
    return file;
}

static bool begin(Snapshot *snapshot, const char *path, const Scene *scene, Error *error)
{
    Output *output = &snapshot->output;
    if (!output_begin(output, path, error) || !output_lock(&snapshot->older, output->path, error))
        return false;
    hdf5_listen();
    snapshot->file = create_file(output->temp);
    if (snapshot->file < 0 || !write_root(snapshot->file, scene))
        return hdf5_fail(error, path, "cannot be written");
    return output_lock(&snapshot->lock, output->temp, error);
}

Snapshot *snapshot_create(const char *path, const Scene *scene, Error *error)
{
    Snapshot *snapshot = calloc(1, sizeof *snapshot);
    if (!snapshot) {
        error_set(error, "%s: out of memory", path);
        return NULL;
    }
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

bool snapshot_note_hand(Snapshot *snapshot, const char *mark, Error *error)
{
    return !*mark || write_texts(snapshot->file, SNAPSHOT_HAND, SCALAR, strlen(mark) + 1, mark) ||
           hdf5_fail(error, snapshot->output.path, "cannot be written");
}

Snapshot *snapshot_continue(const char *path, const WorldDef *world, size_t steps, OutputLock *lock,
                            Error *error)
{
    Snapshot *snapshot = calloc(1, sizeof *snapshot);
    char name[32];
    if (!snapshot) {
        error_set(error, "%s: out of memory", path);
        return NULL;
    }
    const hid_t access = snapshot_access();
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
    if (snapshot->file < 0 || (H5Lexists(snapshot->file, name, H5P_DEFAULT) > 0 &&
                               H5Ldelete(snapshot->file, name, H5P_DEFAULT) < 0)) {
        hdf5_fail(error, path, "cannot be written");
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
    free(snapshot->id);
    snapshot->position = snapshot->velocity = NULL;
    snapshot->fluid = snapshot->id = NULL;
    snapshot->capacity = 0;
}

/* Gives back the room that was reserved behind the end of the file. */
static void trim(const char *path)
{
    struct stat status;
    if (stat(path, &status) == 0 && truncate(path, status.st_size) != 0)
        return; /* the room stays reserved, nothing else */
}

void snapshot_close(Snapshot *snapshot)
{
    if (!snapshot)
        return;
    if (snapshot->file >= 0)
        H5Fclose(snapshot->file);
    if (snapshot->steps > 0)
        trim(snapshot->output.path);
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

static size_t step_bytes(const SnapshotStep *step)
{
    size_t bytes = ((size_t)step->own_count + (step->born != NULL)) * sizeof(float);
#define X(name, type, field) bytes += sizeof(type);
    SNAPSHOT_FIELDS(X)
#undef X
    return STEP_OVERHEAD_BYTES + bytes * step->count +
           bytes * step->count / 256; /* the last: trees of chunks */
}

/* Takes the room for one more step, or fails while the file is still whole: HDF5 writes its directory and its
   data in no order that would survive a full disk. */
static bool reserve(Snapshot *snapshot, size_t bytes, Error *error)
{
    int *file = NULL;
    struct stat status;
    struct rlimit limit;
    int reason = 0;
    if (H5Fget_vfd_handle(snapshot->file, H5P_DEFAULT, (void **)&file) < 0 || fstat(*file, &status) != 0)
        return hdf5_fail(error, snapshot->output.path, "cannot be written");
    if (getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY &&
        (rlim_t)status.st_size + bytes > limit.rlim_cur)
        reason = EFBIG;
    else if (fallocate(*file, FALLOC_FL_KEEP_SIZE, status.st_size, (off_t)bytes) != 0 &&
             (errno == ENOSPC || errno == EFBIG || errno == EDQUOT))
        reason = errno;
    if (reason)
        return error_set(error, "%s: cannot be written: %s; step %zu needs up to %zu KiB",
                         snapshot->output.path, strerror(reason), snapshot->steps, bytes >> 10);
    return true;
}

/* Shuffled bytes and the lightest gzip; a field without particles can't be chunked. */
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

static bool write_field(hid_t group, const char *name, hid_t type, size_t count, const void *values)
{
    hsize_t size = count;
    hid_t space = H5Screate_simple(1, &size, NULL);
    hid_t layout = field_layout(count);
    hid_t set = H5Dcreate2(group, name, type, space, H5P_DEFAULT, layout, H5P_DEFAULT);
    bool written = set >= 0 && H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0;
    written = (set < 0 || H5Dclose(set) >= 0) && written;
    H5Pclose(layout);
    H5Sclose(space);
    return written;
}

static bool write_fields(hid_t group, const SnapshotStep *step)
{
    bool written = true;
#define X(name, count, values)                                                                               \
    written = written && write_doubles(group, name, count == 1 ? SCALAR : count, values);
    SNAPSHOT_ATTRIBUTES(X)
#undef X
#define X(name, type, field)                                                                                 \
    written = written && write_field(group, name, SNAPSHOT_TYPE(step->field), step->count, step->field);
    SNAPSHOT_FIELDS(X)
#undef X
    for (int k = 0; k < step->own_count; k++)
        written = written &&
                  write_field(group, step->own[k].name, H5T_IEEE_F32LE, step->count, step->own[k].values);
    if (step->born)
        written =
            written && write_field(group, scalar_name(SCALAR_BORN), H5T_IEEE_F32LE, step->count, step->born);
    written =
        written && write_doubles(group, SNAPSHOT_RESTART, WORLD_NUMBERS, (const double *)&step->restart);
    return written && write_values(group, SNAPSHOT_STEP_NUMBER, H5T_STD_U64LE, SCALAR, &step->step);
}

/* A program may be killed between any two writes to the disk. So the step is built where the file's directory
   does not yet lead, goes to the disk, gets its mark, and only then its name; the directory has room for the
   name without growing, so that the last flush overwrites a few bytes in place. Where it does have to grow,
   once in 128 steps, four writes are left between which a kill makes the file unreadable. */
static bool write_step(Snapshot *snapshot, const SnapshotStep *step)
{
    const int32_t complete = 1;
    char name[32];
    snapshot_group_name(snapshot->steps, name);
    hid_t group = H5Gcreate_anon(snapshot->file, H5P_DEFAULT, H5P_DEFAULT);
    bool written = group >= 0 && write_fields(group, step) &&
                   H5Fflush(snapshot->file, H5F_SCOPE_LOCAL) >= 0 &&
                   write_values(group, SNAPSHOT_COMPLETE, H5T_STD_I32LE, SCALAR, &complete) &&
                   H5Fflush(snapshot->file, H5F_SCOPE_LOCAL) >= 0 &&
                   H5Olink(group, snapshot->file, name, H5P_DEFAULT, H5P_DEFAULT) >= 0;
    written = (group < 0 || H5Gclose(group) >= 0) && written;
    return written && H5Fflush(snapshot->file, H5F_SCOPE_LOCAL) >= 0;
}

bool snapshot_append_step(Snapshot *snapshot, const SnapshotStep *step, Error *error)
{
    if (snapshot->failed)
        return error_set(error, "%s: takes no more steps after a failed one", snapshot->output.path);
    snapshot->failed = true;
    if (!reserve(snapshot, step_bytes(step), error))
        return false;
    if (!write_step(snapshot, step))
        return hdf5_fail(error, snapshot->output.path, "cannot be written");
    if (snapshot->steps == 0 && !output_lock_commit(&snapshot->older, &snapshot->output, error))
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
    count = count > 0 ? count : 1; /* a first step without particles has all datasets too */
    snapshot->position = malloc(4 * count * sizeof(float));
    snapshot->velocity = malloc(4 * count * sizeof(float));
    snapshot->fluid = malloc(count * sizeof(uint32_t));
    snapshot->id = malloc(count * sizeof(uint32_t));
    if (!snapshot->position || !snapshot->velocity || !snapshot->fluid || !snapshot->id ||
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
    step->count = info->count;
    world_save_numbers(world, &step->restart);
    ParticleArrays arrays = {
        .position = snapshot->position,
        .velocity = snapshot->velocity,
        .scalar = {[SCALAR_DENSITY] = step->density,
                   [SCALAR_PRESSURE] = step->pressure,
                   [SCALAR_COMPRESSION] = step->compression,
                   [SCALAR_BORN] = step->born},
        .fluid = snapshot->fluid,
        .id = snapshot->id,
    };
    for (int k = 0; k < step->own_count; k++)
        arrays.own[step->own[k].place] = step->own[k].values;
    const bool read = world_read(world, &arrays);
    for (size_t i = 0; i < info->count; i++) {
        for (int axis = 0; axis < 3; axis++) {
            step->position[axis][i] = snapshot->position[4 * i + axis];
            step->velocity[axis][i] = snapshot->velocity[4 * i + axis];
        }
        step->fluid[i] = (int32_t)snapshot->fluid[i];
        step->id[i] = snapshot->id[i];
    }
    return read;
}

bool snapshot_append(Snapshot *snapshot, World *world, Error *error)
{
    WorldInfo info;
    world_info(world, &info);
    if (!grow_buffers(snapshot, info.count, error))
        return false;
    if (!read_world(snapshot, world, &info))
        return error_set(error, "%s: no memory to read %zu particles", snapshot->output.path, info.count);
    return snapshot_append_step(snapshot, &snapshot->buffer, error);
}
