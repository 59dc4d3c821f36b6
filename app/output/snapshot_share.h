/* Several processes that write one file of snapshots, each its own particles. All processes make the same
   calls in the same order, with the same scene, and with worlds that differ only in their particles. */
#ifndef SLOSH_SNAPSHOT_SHARE_H
#define SLOSH_SNAPSHOT_SHARE_H

#include "app/output/snapshot.h"

#include <hdf5.h>

typedef struct SnapshotShare {
    bool first;              /* the process that names, locks and removes the file, and reserves disk space */
    hid_t (*access)(void);   /* for collective opening; the caller closes the result */
    hid_t (*transfer)(void); /* for collective writing of a dataset; the caller closes the result */
    /* True if `ok` on all processes; otherwise each process gets the error of the first failing process. */
    bool (*agree)(bool ok, Error *error);
    void (*end)(const Error *error);             /* ends all processes, as the rest wait within HDF5 */
    void (*tell)(void *bytes, size_t size);      /* copies the first process' bytes to all */
    size_t (*held)(void);                        /* count of the process' particles, from world_read */
    size_t (*before)(size_t count, size_t *all); /* count of particles on the processes before, and on all */
} SnapshotShare;

/* Like snapshot_create and snapshot_resume; `share` must outlive the result. These functions fail on all
   processes or on none, as snapshot_append then does. Only the first process gets the particles of
   `state`. */
Snapshot *snapshot_create_shared(const char *path, const Scene *scene, const SnapshotShare *share,
                                 Error *error);
Snapshot *snapshot_resume_shared(const char *path, const Scene *scene, const SnapshotShare *share,
                                 WorldState *state, Error *error);

#endif
