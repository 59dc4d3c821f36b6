/* Names and types of the snapshot file, shared by writer and reader. */
#ifndef SLOSH_SNAPSHOT_FILE_H
#define SLOSH_SNAPSHOT_FILE_H

#include "app/base/output_lock.h"
#include "app/output/snapshot.h"

#include <hdf5.h>
#include <stdint.h>

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

/* Attribute of the root: the settings of the scene, see scene_print. */
#define SNAPSHOT_SETTINGS "settings"

/* Attribute of the root: the folder for the scene's relative file names. */
#define SNAPSHOT_FOLDER "scene_folder"

/* Attribute of the root: the units of the datasets, a line "NAME = UNIT" each. */
#define SNAPSHOT_UNITS "units"

/* Attribute of the root: the source of the box's motion, see snapshot_note_hand. */
#define SNAPSHOT_HAND "hand"

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

/* Counts the groups Step#0, Step#1, ... without a gap, by name only; returns false if the file is
   unreadable. */
bool snapshot_count_names(hid_t file, size_t *steps);

/* Makes a Snapshot that appends states of a world to a file with `steps` complete steps; takes ownership of
   the file's lock. `share`: see app/output/snapshot_share.h, or NULL. Returns NULL with the reason. */
struct SnapshotShare;
Snapshot *snapshot_continue(const char *path, const WorldDef *world, size_t steps, OutputLock *lock,
                            const struct SnapshotShare *share, Error *error);

/* A text attribute of the root in new memory; NULL if missing. */
char *snapshot_root_text(const SnapshotReader *reader, const char *name);

#endif
