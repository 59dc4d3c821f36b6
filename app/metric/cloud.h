/* The particles of a world, read back for the metrics. */
#ifndef SLOSH_CLOUD_H
#define SLOSH_CLOUD_H

#include "sim/world/world.h"

/* Pure data: tests can fill in a cloud by hand. */
typedef struct Cloud {
    size_t count;
    double spacing, support_radius; /* m */
    float *position, *velocity;     /* 4 per particle: x y z 0; m, m/s */
    float *density, *pressure;      /* kg/m3, Pa */
    uint32_t *fluid;
} Cloud;

/* Reads the present state of `world`, replacing the contents of `cloud`. Zero-initialise `cloud` before
   the first call. Returns false if memory is short. */
bool cloud_read(Cloud *cloud, World *world);
void cloud_free(Cloud *cloud);

#endif
