/* The snapshot file in HDF5 terms: one file written by several processes, attributes of the root, errors. */
#ifndef APP_FILES_SNAPSHOT_HDF5_H
#define APP_FILES_SNAPSHOT_HDF5_H

#include "app/files/snapshot.h"
#include "sim/error.h"

#include <hdf5.h>
#include <stdint.h>

/* Notes HDF5's failures on this thread from now on instead of printing; forgets earlier notes. Call before
   the first use of a file: HDF5 then does not clean up at exit, which would print many messages after a
   failed write. */
void hdf5_note_errors(void);

/* Several processes that write one file of snapshots, each its own particles. All processes make the same
   calls in the same order, with the same scene, and with worlds that differ only in their particles. */

typedef struct SnapshotParallel {
    bool first;              /* the process that names, locks and removes the file, and reserves disk space */
    hid_t (*access)(void);   /* for collective opening; the caller closes the result */
    hid_t (*transfer)(void); /* for collective writing of a dataset; the caller closes the result */
    /* True if `ok` on all processes; otherwise each process gets the error of the first failing process. */
    bool (*agree)(bool ok, Error *error);
    void (*end)(const Error *error);             /* ends all processes, as the rest wait within HDF5 */
    void (*tell)(void *bytes, size_t size);      /* copies the first process' bytes to all */
    size_t (*before)(size_t count, size_t *all); /* count of particles on the processes before, and on all */
} SnapshotParallel;

/* Attribute of the root: the settings of the scene, see scene_print. */
#define SNAPSHOT_SETTINGS "settings"

/* Attribute of the root: the folder for the scene's relative file names. */
#define SNAPSHOT_FOLDER "scene_folder"

/* A text attribute of the root in new memory; NULL if missing. */
char *snapshot_root_text(const SnapshotReader *reader, const char *name);

#endif
