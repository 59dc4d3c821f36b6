/* Names and types of the snapshot file, shared by writer and reader. */
#ifndef SLOSH_SNAPSHOT_FILE_H
#define SLOSH_SNAPSHOT_FILE_H

#include "app/base/output_lock.h"
#include "app/output/snapshot.h"

#include <hdf5.h>
#include <stdint.h>

/* HDF5's type of a field of SnapshotStep; the file has the same. */
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

/* The settings of the scene, of the root: see scene_print. */
#define SNAPSHOT_SETTINGS "settings"

/* The folder that the files of the scene were found from, of the root. */
#define SNAPSHOT_FOLDER "scene_folder"

/* The units of the datasets, of the root: a line "NAME = UNIT" each. */
#define SNAPSHOT_UNITS "units"

/* What moved the box, of the root: see snapshot_note_hand. */
#define SNAPSHOT_HAND "hand"

/* The colours of the fluids, of the root: red, green, blue of each as in the scene file, sRGB 0 to 1. */
#define SNAPSHOT_COLORS "fluid_colors"

/* What a run goes on from: WORLD_NUMBERS doubles of a step. */
#define SNAPSHOT_RESTART "restart"

/* The field that files of older versions lack. */
#define SNAPSHOT_COMPRESSION "compression"

/* A step's number of substeps, and the mark of a whole step: each one integer. */
#define SNAPSHOT_STEP_NUMBER "step"
#define SNAPSHOT_COMPLETE    "complete"

/* "Step#k": no leading zeros, or ParaView does not find it. */
static inline void snapshot_group_name(size_t index, char name[32])
{
    snprintf(name, 32, "Step#%zu", index);
}

/* Access without file locks: others may look at a file that is being written, and network folders that have
   no locks still work. -1 on failure; the caller closes it. */
hid_t snapshot_access(void);

/* How many groups Step#0, Step#1, ... the file has without a gap, by their names alone; false when it cannot
   be read. */
bool snapshot_count_names(hid_t file, size_t *steps);

/* A Snapshot that appends states of a world to a file that has so many whole steps, and takes over its lock,
   which is then no longer the caller's. `share`: of app/output/snapshot_share.h, or NULL. NULL with the
   reason. */
struct SnapshotShare;
Snapshot *snapshot_continue(const char *path, const WorldDef *world, size_t steps, OutputLock *lock,
                            const struct SnapshotShare *share, Error *error);

/* The text attribute of the root in new memory; NULL when there is none. */
char *snapshot_root_text(const SnapshotReader *reader, const char *name);

#endif
