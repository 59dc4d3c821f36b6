/* One file of snapshots, written by all ranks. */
#ifndef SLOSH_DIST_SHARE_H
#define SLOSH_DIST_SHARE_H

#include "app/output/snapshot_share.h"

/* Behind MPI_Init. The particles are those of the last world that was made. */
const SnapshotShare *dist_share(void);

/* Collective: whether it went well on all ranks; else all have the error of the first one on which it did
 * not. */
bool dist_agree(bool ok, Error *error);

#endif
