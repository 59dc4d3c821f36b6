/* Cache of volume data. */
#ifndef SLOSH_VOLUME_KEPT_H
#define SLOSH_VOLUME_KEPT_H

#include "sim/base/error.h"
#include "sim/surface/ranged_volume.h"

/* Returns the data of a header and its raw file, reading the files unless unchanged since the last read.
   The data lives as long as the program, as scenes are copied and have no single owner; equal values at
   equal positions are kept once. Returns NULL with the reason, as volume_file_load. Main thread only. */
const RangedVolume *volume_kept(const char *path, Error *error);

#endif
