/* Volume data that are read once and kept. */
#ifndef SLOSH_VOLUME_KEPT_H
#define SLOSH_VOLUME_KEPT_H

#include "sim/base/error.h"
#include "sim/surface/ranged_volume.h"

/* The data of a header and its raw file, which are read unless both are the files that were read before. What
   was read lives as long as the program: scenes are copied, with nobody to own it; files with the same values
   at the same places are kept once. NULL with the reason, as of volume_file_load. Of the main thread. */
const RangedVolume *volume_kept(const char *path, Error *error);

#endif
