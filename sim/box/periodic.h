/* Periodic sides: particles that leave there enter on the opposite side, and neighbours see each other
   across. After: M. P. Allen, D. J. Tildesley, "Computer Simulation of Liquids", 1987, sec. 1.5.2.
   Positions stay in [low, low + size], up to single-precision rounding (on cpu from the end of a step on).
   Along a periodic axis the box is at least two support radii wide, so that no particle sees a neighbour
   twice. */
#ifndef SLOSH_PERIODIC_H
#define SLOSH_PERIODIC_H

#include "sim/box/place.h"

#include <math.h>
#include <stdbool.h>

typedef struct Periodic {
    bool any;
    bool axis[3];
    float low[3], size[3]; /* m, of all axes */
} Periodic;

/* Wraps x (m) into the box along the periodic axes. `left`: rounding remainder of x, or NULL. */
static inline void periodic_wrap(const Periodic *periodic, float x[3], float left[3])
{
    for (int k = 0; k < 3; k++) {
        const float size = periodic->size[k], from = x[k] - periodic->low[k];
        if (periodic->axis[k] && !(from >= 0 && from < size))
            place_move(&x[k], left ? &left[k] : NULL, -size * floorf(from / size));
    }
}

/* Replaces d, a difference of two positions (m), by its shortest image. */
static inline void periodic_nearest(const Periodic *periodic, float d[3])
{
    for (int k = 0; k < 3; k++)
        if (periodic->axis[k])
            d[k] -= periodic->size[k] * rintf(d[k] / periodic->size[k]);
}

#endif
