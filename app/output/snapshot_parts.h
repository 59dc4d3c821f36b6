/* The parts of a snapshot file in HDF5's terms; private to the writer. */
#ifndef SLOSH_SNAPSHOT_PARTS_H
#define SLOSH_SNAPSHOT_PARTS_H

#include "app/output/snapshot_file.h"
#include "app/output/snapshot_share.h"

/* A count that means a single value, not a list. */
enum { SNAPSHOT_SCALAR = 0 };

/* The range of a process' particles among all particles, and the transfer mode of writes. */
typedef struct Extent {
    size_t begin, own, all;
    hid_t transfer;
} Extent;

/* Write an attribute of `count` values; of `count` strings of `stride` bytes each. */
bool snapshot_write_values(hid_t at, const char *name, hid_t type, size_t count, const void *values);
bool snapshot_write_texts(hid_t at, const char *name, size_t count, size_t stride, const char *texts);

/* Writes the root's attributes for the scene. */
bool snapshot_write_root(hid_t file, const Scene *scene);

/* Writes a complete step with its number, synced to the disk. */
bool snapshot_write_step(hid_t file, size_t number, const SnapshotStep *step, const Extent *extent);

/* ---- disk space: snapshot_room.c ---- */

/* Greatest size of a step with `count` particles of all processes. */
size_t snapshot_step_bytes(const SnapshotStep *step, size_t count);

/* Reserves `bytes` after the end of the file, whose present name is `path`. Returns 0, or an errno: from the
   process that reserves (the first), or from a limit of this process. `share`: NULL for a single process;
   otherwise collective. */
int snapshot_take_room(hid_t file, const char *path, const SnapshotShare *share, size_t bytes);

/* Releases unused reserved space. */
void snapshot_trim(const char *path);

#endif
