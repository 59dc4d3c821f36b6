/* What all kinds of `slosh export` share, and those of slices and trails. */
#ifndef SLOSH_EXPORT_PARTS_H
#define SLOSH_EXPORT_PARTS_H

#include "app/output/snapshot.h"
#include "app/session/args.h"

/* The snapshots of the command line, at least one; a gap behind them is told. False with the reason; *reader
   is to be closed in either case. */
bool export_open(const Args *args, SnapshotReader **reader, Error *error);

/* The last snapshot, or the first at or after --time. */
bool export_choose(const Args *args, SnapshotReader *reader, size_t *index, Error *error);

/* The scalar of that name; false with those there are. */
bool export_scalar(const char *name, Scalar *scalar, Error *error);

/* Whether snapshot `index` has it; false with those that it has. */
bool export_has_scalar(const Args *args, SnapshotReader *reader, size_t index, Scalar scalar, Error *error);

/* False where an option or the output's name is of a slice, and --slice is not there. */
bool export_needs_slice(const Args *args, Error *error);

/* What --scalar and --kernel take; NULL after the last. */
const char *export_scalar_choice(int index);
const char *export_kernel_choice(int index);

/* With --slice; returns the exit code. */
int export_slice(const Args *args);

/* With --trails; the same. */
int export_trails(const Args *args);

#endif
