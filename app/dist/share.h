/* A snapshot file shared by all ranks. */
#ifndef SLOSH_DIST_SHARE_H
#define SLOSH_DIST_SHARE_H

#include "app/files/snapshot_hdf5.h"

/* Returns the callbacks; call after MPI_Init. The particles are those of the last made world. */
const SnapshotParallel *dist_share(void);

/* Collective: returns true if `ok` on all ranks; else all ranks get the error of the first failing rank. */
bool dist_agree(bool ok, Error *error);

#endif
