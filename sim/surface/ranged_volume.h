/* Volume data with the range of the values, as handed over by file readers. */
#ifndef SLOSH_RANGED_VOLUME_H
#define SLOSH_RANGED_VOLUME_H

#include "sim/surface/volume_field.h"

/* Constant; must outlive all readers. */
typedef struct RangedVolume {
    VolumeData volume;
    float low, high; /* least and greatest finite value; both 0: none */
} RangedVolume;

#endif
