/* Shared parts of all kinds of `slosh export`, and the exports of slices and trails. */
#ifndef SLOSH_EXPORT_PARTS_H
#define SLOSH_EXPORT_PARTS_H

#include "app/files/snapshot.h"
#include "app/session/args.h"

/* Opens the snapshots of the command line, at least one; reports a gap at the end. Returns false with the
   reason; close *reader in any case. */
bool export_open(const Args *args, SnapshotReader **reader, Error *error);

/* Chooses the last snapshot, or the first at or after --time. */
bool export_choose(const Args *args, SnapshotReader *reader, size_t *index, Error *error);

/* Finds the scalar of that name; returns false with the list of names. */
bool export_scalar(const char *name, Scalar *scalar, Error *error);

/* True if snapshot `index` has the scalar; otherwise the error lists the scalars. */
bool export_has_scalar(const Args *args, SnapshotReader *reader, size_t index, Scalar scalar, Error *error);

/* Returns false if an option or the output's name needs --slice, which is missing. */
bool export_needs_slice(const Args *args, Error *error);

/* Values of --scalar and --kernel; NULL after the last. */
const char *export_scalar_choice(int index);
const char *export_kernel_choice(int index);

/* Runs --slice; returns the exit code. */
int export_slice(const Args *args);

/* Runs --trails; returns the exit code. */
int export_trails(const Args *args);

#endif
