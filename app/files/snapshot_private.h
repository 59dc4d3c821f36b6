/* Private to the writer and the reader of snapshots. */
#ifndef APP_FILES_SNAPSHOT_PRIVATE_H
#define APP_FILES_SNAPSHOT_PRIVATE_H

#include "app/base/file.h"
#include "app/files/snapshot_hdf5.h"

/* ---- names and types in the file ---- */

/* HDF5's type of a field of SnapshotStep, also used in the file. */
#define SNAPSHOT_TYPE(field)                                                                                 \
    _Generic((field), float * : H5T_IEEE_F32LE, int32_t * : H5T_STD_I32LE, int64_t * : H5T_STD_I64LE)

/* X(attribute of a step, number of doubles, field of SnapshotStep as a double *) */
#define SNAPSHOT_ATTRIBUTES(X)                                                                               \
    X("TimeValue", 1, &step->time)                                                                           \
    X("box_position", 3, step->box.position)                                                                 \
    X("box_orientation", 4, step->box.orientation)                                                           \
    X("box_velocity", 3, step->box.velocity)                                                                 \
    X("box_angular_velocity", 3, step->box.angular_velocity)                                                 \
    X("gravity", 3, step->gravity)

/* Attribute of the root: the units of the datasets, a line "NAME = UNIT" each. */
#define SNAPSHOT_UNITS "units"

/* Attribute of the root: the source of the box's motion, see snapshot_note_motion_source. */
#define SNAPSHOT_MOTION_SOURCE "hand"

/* Attribute of the root: the colours of the fluids, red, green, blue of each as in the scene file, sRGB 0 to
   1. */
#define SNAPSHOT_COLORS "fluid_colors"

/* Attribute of a step for a restart: WORLD_NUMBERS doubles. */
#define SNAPSHOT_RESTART "restart"

/* A field missing in files of older versions. */
#define SNAPSHOT_COMPRESSION "compression"

/* A step's number of substeps, and the mark of a complete step: one integer each. */
#define SNAPSHOT_STEP_NUMBER "step"
#define SNAPSHOT_COMPLETE    "complete"

/* Makes "Step#k" without leading zeros, as required by ParaView. */
static inline void snapshot_group_name(size_t index, char name[32])
{
    snprintf(name, 32, "Step#%zu", index);
}

/* Access without file locks, so that other programs may read during writing, and network folders without
   locks work. Returns -1 on failure; the caller closes the access. */
hid_t snapshot_access(void);

/* Makes a writer that appends states of a world to a file with `steps` complete steps; takes ownership of
   the file's lock. `share`: see app/files/snapshot_hdf5.h, or NULL. Returns NULL with the reason. */
SnapshotWriter *snapshot_continue(const char *path, const WorldDef *world, size_t steps, OutputLock *lock,
                                  const SnapshotParallel *share, Error *error);

/* Returns false; `error`: "path: what: the reason of the first noted failure". Clean-up calls between failure
   and call are allowed. */
bool hdf5_fail(Error *error, const char *path, const char *what);

/* A count that means a single value, not a list. */
enum { SNAPSHOT_SCALAR = 0 };

/* The range of a process' particles among all particles, and the transfer mode of writes. */
typedef struct SnapshotExtent {
    size_t begin, own, all;
    hid_t transfer;
} SnapshotExtent;

/* ---- foreign particles ---- */

typedef struct SnapshotForeign SnapshotForeign;

/* As snapshot_open_foreign. */
SnapshotForeign *snapshot_foreign_open(const char *path, const SnapshotAssumptions *assume, Notes *notes,
                                       Error *error);
void snapshot_foreign_close(SnapshotForeign *foreign); /* NULL is allowed */
size_t snapshot_foreign_count(const SnapshotForeign *foreign);
const SnapshotScene *snapshot_foreign_scene(const SnapshotForeign *foreign);
bool snapshot_foreign_time(SnapshotForeign *foreign, size_t index, double *time, Error *error);
bool snapshot_foreign_read(SnapshotForeign *foreign, size_t index, SnapshotStep *step, Error *error);

/* ---- steps in memory ---- */

/* Allocates the method's own columns of a saved state (columns_saved); returns false if memory is short. */
bool snapshot_step_allocate_method_columns(SnapshotStep *step, const ColumnRows *saved);

/* Allocates the births; returns false if memory is short. */
bool snapshot_step_allocate_births(SnapshotStep *step);

/* Allocates the array of a shown scalar; NULL if memory is short. */
float *snapshot_step_allocate_scalar(SnapshotStep *step, Scalar scalar);

/* For a step of snapshot_read_for_display: the values of a scalar of OWN_SCALAR_LIST or of the birth; NULL:
   missing. */
const float *snapshot_step_scalar(const SnapshotStep *step, Scalar scalar);

/* Reads the columns of snapshot_step_allocate_method_columns and the births of the file into the step.
   Returns false with an empty step if the file lacks a column. */
bool snapshot_read_method_columns(SnapshotReader *reader, size_t index, const ColumnRows *saved,
                                  SnapshotStep *step, Error *error);

#endif
