/* What stands in a file of snapshots, as HDF5 takes it: for the writer alone. */
#ifndef SLOSH_SNAPSHOT_PARTS_H
#define SLOSH_SNAPSHOT_PARTS_H

#include "app/output/snapshot_file.h"

/* A count that stands for one value that is no list. */
enum { SNAPSHOT_SCALAR = 0 };

/* Where a process' particles stand among those of all, and how they are written. */
typedef struct Extent {
    size_t begin, own, all;
    hid_t transfer;
} Extent;

/* An attribute of `count` values; of strings of `stride` bytes each. */
bool snapshot_write_values(hid_t at, const char *name, hid_t type, size_t count, const void *values);
bool snapshot_write_texts(hid_t at, const char *name, size_t count, size_t stride, const char *texts);

/* What the root says of the scene. */
bool snapshot_write_root(hid_t file, const Scene *scene);

/* All of a step but its mark. */
bool snapshot_write_fields(hid_t group, const SnapshotStep *step, const Extent *extent);

#endif
