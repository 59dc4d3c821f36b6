/* Several processes that write one file of snapshots, each its own particles: all of them make the same calls
   in the same order, with the same scene and worlds that differ in their particles alone. */
#ifndef SLOSH_SNAPSHOT_SHARE_H
#define SLOSH_SNAPSHOT_SHARE_H

#include "app/output/snapshot.h"

#include <hdf5.h>

typedef struct SnapshotShare {
    bool first;              /* the process that names, locks and removes the file, and takes room for it */
    hid_t (*access)(void);   /* to open it together; the caller closes it */
    hid_t (*transfer)(void); /* to write a dataset together; the caller closes it */
    /* Whether it is so for all; else each one's error is that of the first for which it is not. */
    bool (*agree)(bool ok, Error *error);
    void (*end)(const Error *error);             /* ends all: the others wait for this one within HDF5 */
    void (*tell)(void *bytes, size_t size);      /* what the first one has becomes that of all */
    size_t (*held)(void);                        /* this one's particles: world_read gives them */
    size_t (*before)(size_t count, size_t *all); /* those of the processes before this one, and of all */
} SnapshotShare;

/* As snapshot_create and snapshot_resume; `share` outlives it. They fail for all or for none, as
   snapshot_append then does. Of the state to go on from the first process alone has the particles. */
Snapshot *snapshot_create_shared(const char *path, const Scene *scene, const SnapshotShare *share,
                                 Error *error);
Snapshot *snapshot_resume_shared(const char *path, const Scene *scene, const SnapshotShare *share,
                                 WorldState *state, Error *error);

#endif
