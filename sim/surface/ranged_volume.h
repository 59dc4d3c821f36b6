/* Volume data with the range of their values: what who reads a file hands over. */
#ifndef SLOSH_RANGED_VOLUME_H
#define SLOSH_RANGED_VOLUME_H

#include "sim/surface/volume_field.h"

/* Constant; outlives all that reads it. */
typedef struct RangedVolume {
    VolumeData volume;
    float low, high; /* the least and the greatest value that is a number; both 0: there is none */
} RangedVolume;

#endif
