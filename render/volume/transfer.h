/* The transfer function of translucent fluid as a table for shaders/volume/raycast_gather.glsl. By
   position on the field's ramp: the curve, its integral from 0 on, and its total rise and fall; by
   position in the scalar's range: the opacity. With integrals, a piece of a ray between two samples is
   exact for any curve. After: Engel, Kraus, Ertl, High-quality pre-integrated volume rendering, 2001, in
   one dimension, for a field that is linear between samples. */
#ifndef SLOSH_TRANSFER_H
#define SLOSH_TRANSFER_H

#include "sim/base/control_points.h"

#include <stdbool.h>

enum { TRANSFER_ENTRIES = 256 };

/* Four floats per entry, at x = i / (TRANSFER_ENTRIES - 1). Below 0 the curve is 0: a first value above 0
   counts as a rise at 0. */
void transfer_fill(const ControlPoints *curve, const ControlPoints *opacity,
                   float table[4 * TRANSFER_ENTRIES]);

/* The table as a texture, RGBA32F, linear. */
typedef struct Transfer {
    unsigned texture; /* 0: not created yet */
    ControlPoints curve, opacity;
} Transfer;

void transfer_destroy(Transfer *transfer);

/* Makes the table for both curves, if different, and binds the texture (TRANSFER_UNIT). */
void transfer_bind(Transfer *transfer, const ControlPoints *curve, const ControlPoints *opacity);

#endif
