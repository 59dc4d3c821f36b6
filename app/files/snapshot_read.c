#include "app/base/program.h"
#include "app/files/foreign/foreign.h"
#include "app/files/snapshot.h"
#include "app/files/snapshot_private.h"
#include "sim/kernel/kernel.h"
#include "sim/step/method.h"

#include <errno.h>
#include <hdf5.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

/* Counts steps by the names of their groups, without opening steps. */

/* Marks the existing names among the first `room`; with room 0 only counts names. */
typedef struct GroupNames {
    size_t count, capacity;
    bool *there;
} GroupNames;

static herr_t look_at_name(hid_t file, const char *name, const H5L_info_t *info, void *user)
{
    GroupNames *names = user;
    char own[32];
    (void)file, (void)info;
    if (strncmp(name, "Step#", 5) != 0)
        return 0;
    const size_t index = strtoul(name + 5, NULL, 10);
    snapshot_group_name(index, own);
    if (strcmp(name, own) != 0)
        return 0;
    names->count++;
    if (index < names->capacity)
        names->there[index] = true;
    return 0;
}

static bool look(hid_t file, GroupNames *names)
{
    names->count = 0;
    return H5Literate(file, H5_INDEX_NAME, H5_ITER_NATIVE, NULL, look_at_name, names) >= 0;
}

/* Counts the groups Step#0, Step#1, ... without a gap, by name only; returns false if the file is
   unreadable. */
static bool snapshot_count_names(hid_t file, size_t *steps)
{
    GroupNames names = {.capacity = 0};
    *steps = 0;
    if (!look(file, &names))
        return false;
    names.there = calloc(names.count + 1, sizeof *names.there);
    names.capacity = names.there ? names.count : 0;
    const bool read = names.there && look(file, &names);
    while (read && *steps < names.capacity && names.there[*steps])
        ++*steps;
    free(names.there);
    return read;
}

enum { SUPPORT_MOST = 10 }; /* spacings; a lattice is summed within this radius; scenes have 1.5 to 4 */

struct SnapshotReader {
    char path[1024];
    SnapshotForeign *foreign; /* NULL: a file of slosh */
    hid_t file;               /* of slosh; else -1 */
    size_t steps;
    struct stat was; /* the file when it was opened */
    bool still;      /* no emitters in the settings: all particles were born at time 0 */
};

static bool read_values(hid_t at, const char *name, hid_t type, size_t count, void *values)
{
    hid_t attribute = H5Aopen(at, name, H5P_DEFAULT);
    hid_t space = attribute >= 0 ? H5Aget_space(attribute) : -1;
    bool read = space >= 0 && H5Sget_simple_extent_npoints(space) == (hssize_t)count &&
                H5Aread(attribute, type, values) >= 0;
    if (space >= 0)
        H5Sclose(space);
    if (attribute >= 0)
        H5Aclose(attribute);
    return read;
}

static hid_t open_step(hid_t file, size_t index)
{
    char name[32];
    snapshot_group_name(index, name);
    return file >= 0 && H5Lexists(file, name, H5P_DEFAULT) > 0 ? H5Gopen2(file, name, H5P_DEFAULT) : -1;
}

static bool step_is_complete(hid_t file, size_t index)
{
    int32_t complete = 0;
    hid_t group = open_step(file, index);
    bool whole = group >= 0 && H5Aexists(group, SNAPSHOT_COMPLETE) > 0 &&
                 read_values(group, SNAPSHOT_COMPLETE, H5T_NATIVE_INT32, 1, &complete) && complete == 1;
    if (group >= 0)
        H5Gclose(group);
    return whole;
}

/* Returns -1 with the reason on failure. */
static hid_t open_file(const char *path, struct stat *was, Error *error)
{
    hdf5_note_errors();
    if (access(path, R_OK) != 0 || stat(path, was) != 0) {
        error_set(error, "%s: cannot be read: %s", path, strerror(errno));
        return -1;
    }
    const hid_t access = snapshot_access(), file = H5Fopen(path, H5F_ACC_RDONLY, access);
    if (file < 0)
        hdf5_fail(error, path, "is no file of snapshots");
    H5Pclose(access);
    return file;
}

/* True if no line of the settings begins with fluids[N].emit[. */
static bool emits_nothing(const SnapshotReader *reader)
{
    static const char fluid[] = "\nfluids[", emit[] = "].emit[";
    char *settings = snapshot_root_text(reader, SNAPSHOT_SETTINGS);
    bool nothing = settings != NULL;
    for (const char *at = settings; nothing && (at = strstr(at, fluid));) {
        at += strlen(fluid);
        at += strspn(at, "0123456789");
        nothing = strncmp(at, emit, strlen(emit)) != 0;
    }
    free(settings);
    return nothing;
}

static SnapshotReader *reader_create(const char *path, Error *error)
{
    SnapshotReader *reader = calloc(1, sizeof *reader);
    if (!reader) {
        error_set(error, "%s: out of memory", path);
        return NULL;
    }
    snprintf(reader->path, sizeof reader->path, "%s", path);
    reader->file = open_file(path, &reader->was, error);
    if (reader->file >= 0) {
        reader->still = emits_nothing(reader);
        return reader;
    }
    free(reader);
    return NULL;
}

SnapshotReader *snapshot_open(const char *path, Error *error)
{
    SnapshotReader *reader = reader_create(path, error);
    while (reader && step_is_complete(reader->file, reader->steps))
        reader->steps++;
    return reader;
}

/* Counts steps by name, and skips incomplete steps at the end; a file of another program has no marks, so no
   steps. */
static bool count_shown(hid_t file, const char *path, size_t *steps, Error *error)
{
    if (!snapshot_count_names(file, steps))
        return hdf5_fail(error, path, "cannot be read");
    if (*steps > 0 && !step_is_complete(file, 0))
        *steps = 0;
    while (*steps > 0 && !step_is_complete(file, *steps - 1))
        --*steps;
    return true;
}

static SnapshotReader *try_shown(const char *path, Error *error)
{
    SnapshotReader *reader = reader_create(path, error);
    if (!reader || count_shown(reader->file, path, &reader->steps, error))
        return reader;
    snapshot_reader_close(reader);
    return NULL;
}

static bool was_just_written(const char *path)
{
    struct stat now;
    return stat(path, &now) == 0 && S_ISREG(now.st_mode) && time(NULL) - now.st_mtim.tv_sec < 2;
}

/* Retries for a moment: between two writes of an active run there may be nothing to read. */
SnapshotReader *snapshot_open_for_display(const char *path, Error *error)
{
    enum { TRIES = 20, PAUSE_NS = 10000000 };
    SnapshotReader *reader = try_shown(path, error);
    for (int k = 1; k < TRIES && (!reader || reader->steps == 0) && was_just_written(path); k++) {
        snapshot_reader_close(reader);
        nanosleep(&(struct timespec){.tv_nsec = PAUSE_NS}, NULL);
        reader = try_shown(path, error);
    }
    return reader;
}

static bool is_unchanged(const struct stat *was, const struct stat *now)
{
    return now->st_size == was->st_size && now->st_mtim.tv_sec == was->st_mtim.tv_sec &&
           now->st_mtim.tv_nsec == was->st_mtim.tv_nsec;
}

static void close_file(SnapshotReader *reader)
{
    if (reader->file >= 0)
        H5Fclose(reader->file);
    reader->file = -1;
}

/* A file of HDF5 without what each file of slosh has in its root. */
static bool is_hdf5_of_others(const char *path)
{
    struct stat was;
    Error none;
    const hid_t file = open_file(path, &was, &none);
    const bool is = file >= 0 && H5Aexists(file, "spacing") <= 0 && H5Aexists(file, SNAPSHOT_SETTINGS) <= 0;
    if (file >= 0)
        H5Fclose(file);
    return is;
}

bool snapshot_is_foreign(const char *path)
{
    const ForeignFormat *format = foreign_format(path);
    return foreign_is_pattern(path) || (format && (format != &foreign_hdf5 || is_hdf5_of_others(path)));
}

SnapshotReader *snapshot_open_foreign(const char *path, const SnapshotAssumptions *assume, Notes *notes,
                                      Error *error)
{
    SnapshotReader *reader = calloc(1, sizeof *reader);
    SnapshotForeign *foreign = reader ? snapshot_foreign_open(path, assume, notes, error) : NULL;
    if (!reader)
        error_set(error, "%s: out of memory", path);
    if (!foreign) {
        free(reader);
        return NULL;
    }
    snprintf(reader->path, sizeof reader->path, "%s", path);
    reader->foreign = foreign;
    reader->file = -1;
    reader->steps = snapshot_foreign_count(foreign);
    return reader;
}

bool snapshot_refresh(SnapshotReader *reader, Error *error)
{
    struct stat now;
    if (reader->foreign) /* whole when opened */
        return true;
    if (stat(reader->path, &now) != 0)
        return error_set(error, "%s: cannot be read: %s", reader->path, strerror(errno));
    if (now.st_ino != reader->was.st_ino || now.st_dev != reader->was.st_dev)
        return error_set(error, "%s: is another file now; open it anew", reader->path);
    if (reader->file >= 0 && is_unchanged(&reader->was, &now))
        return true;
    close_file(reader); /* an open file would keep HDF5's old knowledge of the file */
    reader->file = open_file(reader->path, &reader->was, error);
    if (reader->file >= 0 && count_shown(reader->file, reader->path, &reader->steps, error))
        return true;
    close_file(reader);
    return false;
}

void snapshot_reader_close(SnapshotReader *reader)
{
    if (!reader)
        return;
    close_file(reader);
    snapshot_foreign_close(reader->foreign);
    free(reader);
}

size_t snapshot_count_steps(const SnapshotReader *reader)
{
    return reader->steps;
}

/* Unreadable groups after the last step. */
typedef struct StrayGroups {
    size_t steps, count; /* complete steps before; stray groups after */
    char first[64];      /* the first stray group by name */
} StrayGroups;

static herr_t look_at_link(hid_t file, const char *name, const H5L_info_t *info, void *user)
{
    StrayGroups *stray = user;
    char own[32];
    (void)file, (void)info;
    if (strncmp(name, "Step#", 5) != 0)
        return 0;
    const size_t index = strtoul(name + 5, NULL, 10);
    snapshot_group_name(index, own);
    if (index <= stray->steps && strcmp(name, own) == 0) /* the last: being written, or left by a kill */
        return 0;
    if (stray->count++ == 0)
        snprintf(stray->first, sizeof stray->first, "%s", name);
    return 0;
}

bool snapshot_gap(const SnapshotReader *reader, char words[256])
{
    StrayGroups stray = {.steps = reader->steps};
    char next[32];
    if (reader->foreign)
        return false;
    H5Literate(reader->file, H5_INDEX_NAME, H5_ITER_INC, NULL, look_at_link, &stray);
    snapshot_group_name(reader->steps, next);
    if (stray.count == 1)
        snprintf(words, 256, "%s is missing or not whole, but there is '%s'", next, stray.first);
    else
        snprintf(words, 256, "%s is missing or not whole, but there are %zu behind it, such as '%s'", next,
                 stray.count, stray.first);
    return stray.count > 0;
}

bool snapshot_read_time(SnapshotReader *reader, size_t index, double *time, Error *error)
{
    if (reader->foreign)
        return snapshot_foreign_time(reader->foreign, index, time, error);
    const hid_t group = index < reader->steps ? open_step(reader->file, index) : -1;
    const bool read = group >= 0 && H5Aexists(group, "TimeValue") > 0 &&
                      read_values(group, "TimeValue", H5T_NATIVE_DOUBLE, 1, time);
    if (group >= 0)
        H5Gclose(group);
    return read || error_set(error, "%s: Step#%zu: 'TimeValue' is missing", reader->path, index);
}

/* Reads `width` numbers per fluid; returns the count of fluids. */
static size_t read_fluids(const SnapshotReader *reader, const char *name, size_t width, double *values)
{
    size_t count = reader->file >= 0 && H5Aexists(reader->file, name) > 0 ? FLUIDS_MAX : 0;
    while (count > 0 && !read_values(reader->file, name, H5T_NATIVE_DOUBLE, width * count, values))
        count--;
    return count;
}

size_t snapshot_read_colors(const SnapshotReader *reader, double colors[FLUIDS_MAX][3])
{
    return read_fluids(reader, SNAPSHOT_COLORS, 3, colors[0]);
}

/* The word after `key`, which is a newline, a key and " = "; false if missing. */
static bool setting_word(const char *settings, const char *key, char word[NAME_SIZE])
{
    const char *at = settings ? strstr(settings, key) : NULL;
    return at && sscanf(at + strlen(key), "%31s", word) == 1;
}

/* Sets the method's own choices from the file's settings. */
static void choose_as_said(const char *settings, const Method *method, WorldDef *def)
{
    for (const Key *key = method->keys; key && key->path; key++) {
        char line[NAME_SIZE + 64], word[NAME_SIZE];
        snprintf(line, sizeof line, "\n%.64s = ", key->path);
        if (key->type == KEY_CHOICE && !(key->flags & KEY_INDEX) && setting_word(settings, line, word))
            memcpy((char *)method_def(def, method) + key->offset, word, NAME_SIZE);
    }
}

/* The kernels of the file's method; all NULL if unknown. */
static MethodKernels read_kernels(const SnapshotReader *reader, const Method **method)
{
    char own[NAME_SIZE] = "", *settings = snapshot_root_text(reader, SNAPSHOT_SETTINGS);
    WorldDef def = world_def_default();
    MethodKernels kernels = {NULL};
    *method = setting_word(settings, "\nsolver.method = ", own) ? method_find(own) : NULL;
    if (*method) {
        memcpy(def.method, own, sizeof own);
        choose_as_said(settings, *method, &def);
        kernels = method_kernels(&def);
    }
    free(settings);
    return kernels;
}

/* Calibrates a summed density like sim/step/constants.c; a carried density needs no scale. */
static double read_stiffness_scale(const SnapshotReader *reader, const SnapshotScene *scene)
{
    Lattice lattice = {.stiffness_scale = 1};
    const Method *method;
    const MethodKernels kernels = read_kernels(reader, &method);
    if (method && !method->carries_density && kernels.density)
        lattice_calibrate(scene->dimensions, scene->spacing, scene->support_radius, kernels.density,
                          kernels.slope, &lattice);
    return lattice.stiffness_scale;
}

bool snapshot_kernel(const SnapshotReader *reader, char name[NAME_SIZE])
{
    const Method *method;
    const Kernel *kernel = read_kernels(reader, &method).density;
    if (kernel)
        snprintf(name, NAME_SIZE, "%s", kernel->name);
    return kernel != NULL;
}

/* Reads box.periodic from the settings: "[x, z]". */
static void read_periodic(const SnapshotReader *reader, bool periodic[3])
{
    static const char key[] = "\nbox.periodic = ";
    char *settings = snapshot_root_text(reader, SNAPSHOT_SETTINGS);
    const char *at = settings ? strstr(settings, key) : NULL;
    memset(periodic, false, 3 * sizeof *periodic);
    for (const char *c = at ? at + strlen(key) : ""; *c && *c != '\n'; c++)
        if (*c >= 'x' && *c <= 'z')
            periodic[*c - 'x'] = true;
    free(settings);
}

/* Checks the numbers of a damaged file, which later code would use unchecked. The comparisons also reject
   NaN. */
static bool check_scene(const SnapshotReader *reader, const SnapshotScene *scene, Error *error)
{
    const double *box = scene->box_size, support = scene->support_radius / scene->spacing;
    if (!(scene->spacing > 0 && scene->spacing < INFINITY))
        return error_set(error, "%s: 'spacing' is %g; it must be more than 0", reader->path, scene->spacing);
    if (!(support >= 1 && support <= SUPPORT_MOST))
        return error_set(error, "%s: 'support_radius' is %g spacings; it must be 1 to %d", reader->path,
                         support, SUPPORT_MOST);
    for (int k = 0; k < 3; k++)
        if (!(box[k] > 0 && box[k] < INFINITY))
            return error_set(error, "%s: 'box_size' is %g along %c; it must be more than 0", reader->path,
                             box[k], "xyz"[k]);
    for (size_t k = 0; k < scene->fluid_count; k++)
        if (!(scene->density[k] > 0 && scene->density[k] < INFINITY))
            return error_set(error, "%s: 'fluid_densities' has %g; all must be more than 0", reader->path,
                             scene->density[k]);
    return scene->fluid_count > 0 || error_set(error, "%s: 'fluid_densities' is missing", reader->path);
}

bool snapshot_read_scene(const SnapshotReader *reader, SnapshotScene *scene, Error *error)
{
    const struct {
        const char *name;
        size_t count;
        double *values;
    } numbers[] = {{"spacing", 1, &scene->spacing},
                   {"support_radius", 1, &scene->support_radius},
                   {"box_size", 3, scene->box_size}};
    if (reader->foreign) {
        *scene = *snapshot_foreign_scene(reader->foreign);
        return check_scene(reader, scene, error);
    }
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        if (H5Aexists(reader->file, numbers[i].name) <= 0 ||
            !read_values(reader->file, numbers[i].name, H5T_NATIVE_DOUBLE, numbers[i].count,
                         numbers[i].values))
            return error_set(error, "%s: '%s' is missing", reader->path, numbers[i].name);
    scene->fluid_count = read_fluids(reader, "fluid_densities", 1, scene->density);
    if (!check_scene(reader, scene, error))
        return false;
    /* a two-dimensional box is a spacing deep: WorldDef */
    scene->dimensions = scene->box_size[2] > 1.001 * scene->spacing ? 3 : 2;
    scene->stiffness_scale = read_stiffness_scale(reader, scene);
    read_periodic(reader, scene->periodic);
    return true;
}

char *snapshot_root_text(const SnapshotReader *reader, const char *name)
{
    const bool has = reader->file >= 0 && H5Aexists(reader->file, name) > 0;
    const hid_t attribute = has ? H5Aopen(reader->file, name, H5P_DEFAULT) : -1;
    const hid_t type = attribute >= 0 ? H5Aget_type(attribute) : -1;
    char *text = NULL;
    if (type >= 0 && H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0)
        text = calloc(1, H5Tget_size(type) + 1);
    if (text && H5Aread(attribute, type, text) < 0) {
        free(text);
        text = NULL;
    }
    if (type >= 0)
        H5Tclose(type);
    if (attribute >= 0)
        H5Aclose(attribute);
    return text;
}

/* The length of a one-dimensional dataset; false if there is no such dataset. */
static bool field_length(hid_t group, const char *name, size_t *length)
{
    hid_t set = H5Lexists(group, name, H5P_DEFAULT) > 0 ? H5Dopen2(group, name, H5P_DEFAULT) : -1;
    hid_t space = set >= 0 ? H5Dget_space(set) : -1;
    bool one_dimensional = space >= 0 && H5Sget_simple_extent_ndims(space) == 1;
    if (one_dimensional)
        *length = (size_t)H5Sget_simple_extent_npoints(space);
    if (space >= 0)
        H5Sclose(space);
    if (set >= 0)
        H5Dclose(set);
    return one_dimensional;
}

static bool read_field(hid_t group, const char *name, hid_t type, size_t count, void *values)
{
    size_t length = 0;
    if (!field_length(group, name, &length) || length != count)
        return false;
    hid_t set = H5Dopen2(group, name, H5P_DEFAULT);
    bool read = set >= 0 && H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0;
    if (set >= 0)
        H5Dclose(set);
    return read;
}

/* Reads the restart numbers; of older files only the first WORLD_NUMBERS_LEAST, as the rest may have
   changed. */
static bool read_restart(hid_t group, WorldNumbers *restart)
{
    enum { MOST = 1024 };
    double values[MOST];
    if (read_values(group, SNAPSHOT_RESTART, H5T_NATIVE_DOUBLE, WORLD_NUMBERS, restart))
        return true;
    for (size_t count = WORLD_NUMBERS_LEAST; count < MOST; count++)
        if (read_values(group, SNAPSHOT_RESTART, H5T_NATIVE_DOUBLE, count, values)) {
            memcpy(restart, values, WORLD_NUMBERS_LEAST * sizeof *values);
            return true;
        }
    return false;
}

/* True if an unreadable field may be missing: old files have no compression; for display further fields may
   be missing, but not have a wrong length. */
static bool may_lack(hid_t group, const char *name, const SnapshotStep *step, bool shown)
{
    if (!shown)
        return step->restart.version == 0 && strcmp(name, SNAPSHOT_COMPRESSION) == 0;
    return strlen(name) > strlen("x") && H5Lexists(group, name, H5P_DEFAULT) <= 0;
}

/* Reads a group; returns the name of the first wrong attribute or dataset, or NULL. */
static const char *read_group(hid_t group, SnapshotStep *step, bool shown)
{
    unsigned field = 0;
#define X(name, count, values)                                                                               \
    if (!read_values(group, name, H5T_NATIVE_DOUBLE, count, values))                                         \
        return name;
    SNAPSHOT_ATTRIBUTES(X)
#undef X
    if (H5Aexists(group, SNAPSHOT_RESTART) > 0 && !read_restart(group, &step->restart))
        step->restart.version = 0; /* from a different version of slosh */
    if (!read_values(group, SNAPSHOT_STEP_NUMBER, H5T_NATIVE_UINT64, 1, &step->step))
        return SNAPSHOT_STEP_NUMBER;
    if (H5Lexists(group, SNAPSHOT_COMPRESSION, H5P_DEFAULT) <= 0)
        step->restart.version = 0; /* from a version of slosh without this field */
#define X(name, type, field_of)                                                                              \
    if (!read_field(group, name, SNAPSHOT_TYPE(step->field_of), step->count, step->field_of)) {              \
        if (!may_lack(group, name, step, shown))                                                             \
            return name;                                                                                     \
        step->lacks |= shown ? 1U << field : 0;                                                              \
    }                                                                                                        \
    field++;
    SNAPSHOT_FIELDS(X)
#undef X
    return NULL;
}

enum { DATASET_NAME_SIZE = 32 };

/* Name of the scalar's dataset: NAME_0 for NAME_x, and so on. */
static void dataset_of(Scalar scalar, char name[DATASET_NAME_SIZE])
{
    const size_t end = (size_t)snprintf(name, DATASET_NAME_SIZE, "%s", scalar_name(scalar)) - 1;
    if (name[end - 1] == '_' && name[end] >= 'x')
        name[end] = (char)('0' + name[end] - 'x');
}

/* Reads the scalars of methods and terms in the group. */
static const char *read_shown(hid_t group, SnapshotStep *step)
{
    char name[DATASET_NAME_SIZE];
    for (int s = SCALAR_OWN; s < SCALAR_STATE_COUNT; s++) {
        dataset_of((Scalar)s, name);
        if (H5Lexists(group, name, H5P_DEFAULT) <= 0)
            continue;
        float *values = snapshot_step_allocate_scalar(step, (Scalar)s);
        if (!values || !read_field(group, name, H5T_IEEE_F32LE, step->count, values))
            return scalar_name((Scalar)s);
    }
    return NULL;
}

/* Checks the count, as a damaged file may contain any number. */
static bool fits_memory(size_t count)
{
    size_t bytes = 0;
#define X(name, type, field) bytes += sizeof(type);
    SNAPSHOT_FIELDS(X)
#undef X
    return (double)count * (double)bytes <= memory_bytes();
}

static bool read_step(SnapshotReader *reader, size_t index, bool shown, SnapshotStep *step, Error *error)
{
    size_t count = 0;
    *step = (SnapshotStep){0};
    if (index >= reader->steps)
        return error_set(error, "%s: has no step %zu; it has %zu whole step%s", reader->path, index,
                         reader->steps, plural(reader->steps));
    if (reader->foreign)
        return snapshot_foreign_read(reader->foreign, index, step, error);
    if (shown && !step_is_complete(reader->file, index))
        return error_set(error, "%s: Step#%zu is not whole", reader->path, index);
    hid_t group = open_step(reader->file, index);
    const char *missing = group >= 0 && field_length(group, "x", &count) ? NULL : "x";
    if (!missing && (!fits_memory(count) || !snapshot_step_allocate(step, count))) {
        H5Gclose(group);
        return error_set(error, "%s: Step#%zu: out of memory for %zu particles", reader->path, index, count);
    }
    missing = missing ? missing : read_group(group, step, shown);
    missing = missing || !shown ? missing : read_shown(group, step);
    if (!missing && shown && reader->still && !snapshot_step_scalar(step, SCALAR_BORN) &&
        !snapshot_step_allocate_scalar(step, SCALAR_BORN)) /* calloc leaves all births at 0 */
        missing = scalar_name(SCALAR_BORN);
    if (group >= 0)
        H5Gclose(group);
    if (!missing)
        return true;
    snapshot_step_free(step);
    return error_set(error, "%s: Step#%zu: '%s' is missing or of another length", reader->path, index,
                     missing);
}

bool snapshot_read_step(SnapshotReader *reader, size_t index, SnapshotStep *step, Error *error)
{
    return read_step(reader, index, false, step, error);
}

bool snapshot_read_for_display(SnapshotReader *reader, size_t index, SnapshotStep *step, Error *error)
{
    return read_step(reader, index, true, step, error);
}

bool snapshot_file_has(const char *path, Scalar scalar)
{
    Error none;
    char name[DATASET_NAME_SIZE];
    SnapshotReader *reader = snapshot_open_for_display(path, &none);
    const hid_t group = reader ? open_step(reader->file, 0) : -1;
    dataset_of(scalar, name);
    const bool has = group >= 0 && H5Lexists(group, name, H5P_DEFAULT) > 0;
    if (group >= 0)
        H5Gclose(group);
    snapshot_reader_close(reader);
    return has;
}

/* Fills a missing column with the default of ParticleColumns. */
static void not_known(SnapshotStep *step, int k)
{
    for (size_t i = 0; i < step->count; i++)
        step->own[k].values[i] = step->own[k].place >= COLUMNS_SHOWN ? NAN : 0;
}

bool snapshot_read_method_columns(SnapshotReader *reader, size_t index, const ColumnRows *saved,
                                  SnapshotStep *step, Error *error)
{
    const char *missing = NULL;
    if (!snapshot_step_allocate_method_columns(step, saved)) {
        snapshot_step_free(step);
        return error_set(error, "%s: out of memory", reader->path);
    }
    const hid_t group = open_step(reader->file, index);
    const char *born = scalar_name(SCALAR_BORN);
    if (group >= 0 && H5Lexists(group, born, H5P_DEFAULT) > 0 &&
        (!snapshot_step_allocate_births(step) ||
         !read_field(group, born, H5T_IEEE_F32LE, step->count, step->born)))
        missing = born;
    for (int k = 0; k < step->own_count && !missing; k++)
        if (group >= 0 && step->own[k].place >= COLUMNS_LEFT &&
            H5Lexists(group, step->own[k].name, H5P_DEFAULT) <= 0)
            not_known(step, k);
        else if (group < 0 ||
                 !read_field(group, step->own[k].name, H5T_IEEE_F32LE, step->count, step->own[k].values))
            missing = step->own[k].name;
    if (missing)
        error_set(error,
                  "%s: Step#%zu: '%s' is missing or of another length; it may be of another version of slosh",
                  reader->path, index, missing);
    if (group >= 0)
        H5Gclose(group);
    if (missing)
        snapshot_step_free(step);
    return !missing;
}

SnapshotFlaws snapshot_flaws(const SnapshotReader *reader, bool strict)
{
    SnapshotScene scene = {.dimensions = 0};
    SnapshotFlaws flaws = {.farthest = INFINITY, .fluids = SIZE_MAX, .strict = strict};
    if (!snapshot_read_scene(reader, &scene, NULL))
        return flaws;
    flaws.farthest =
        SNAPSHOT_FARTHEST_BOXES * fmax(scene.box_size[0], fmax(scene.box_size[1], scene.box_size[2]));
    flaws.fluids = scene.fluid_count;
    return flaws;
}
