/* What stands in a file of snapshots, as HDF5 takes it: for the writer alone. */
#ifndef SLOSH_SNAPSHOT_PARTS_H
#define SLOSH_SNAPSHOT_PARTS_H

#include "app/output/snapshot_file.h"
#include "app/output/snapshot_share.h"

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

/* A whole step by its number, on the disk then. */
bool snapshot_write_step(hid_t file, size_t number, const SnapshotStep *step, const Extent *extent);

/* ---- room on the disk: snapshot_room.c ---- */

/* What a step takes at most, with `count` particles of all processes. */
size_t snapshot_step_bytes(const SnapshotStep *step, size_t count);

/* Takes so many bytes behind the end of the file, which has that name now. 0, or why not, as errno has it: in
   the process that takes it (the first one), or by a limit of this process. `share`: NULL of one process;
   else collective. */
int snapshot_take_room(hid_t file, const char *path, const SnapshotShare *share, size_t bytes);

/* Gives back what was taken and is not used. */
void snapshot_trim(const char *path);

#endif
