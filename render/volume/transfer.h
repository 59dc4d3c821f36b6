/* The transfer function of translucent fluid as a table for shaders/volume/raycast_gather.glsl, by the place
   on the ramp of the field: the curve, what it has summed up to from 0 on, and how far it has gone up and
   down; and by the scalar's place in its range the opacity. With sums a piece of a ray between two samples is
   exact, however much the curve has done in between. After: Engel, Kraus, Ertl, High-quality pre-integrated
   volume rendering, 2001, in one dimension, for a field that is linear between samples. */
#ifndef SLOSH_TRANSFER_H
#define SLOSH_TRANSFER_H

#include "sim/base/control_points.h"

#include <stdbool.h>

enum { TRANSFER_ENTRIES = 256 };

/* Four floats an entry, at x = i / (TRANSFER_ENTRIES - 1). Before 0 the curve is 0: a curve that begins
   above it has risen by that at once. */
void transfer_fill(const ControlPoints *curve, const ControlPoints *opacity,
                   float table[4 * TRANSFER_ENTRIES]);

/* The table as a texture, RGBA32F, linear. */
typedef struct Transfer {
    unsigned texture; /* 0: not yet made */
    ControlPoints curve, opacity;
} Transfer;

void transfer_destroy(Transfer *transfer);

/* Makes or changes it for these, and binds it (TRANSFER_UNIT). */
void transfer_bind(Transfer *transfer, const ControlPoints *curve, const ControlPoints *opacity);

#endif
