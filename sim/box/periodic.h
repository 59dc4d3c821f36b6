/* Periodic sides: what leaves the box there comes in on the other side, and neighbours see each other across.

   After: M. P. Allen, D. J. Tildesley, "Computer Simulation of Liquids", 1987, sec. 1.5.2. Positions stay in
   [low, low + size], to the rounding of single precision (on cpu from the end of a step on); the box is at
   least two support radii wide along a periodic axis, so that no particle sees another twice. */
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

/* Puts x (m) into the box along the periodic axes. `left`: what rounding leaves of it, or NULL. */
static inline void periodic_wrap(const Periodic *periodic, float x[3], float left[3])
{
    for (int k = 0; k < 3; k++) {
        const float size = periodic->size[k], from = x[k] - periodic->low[k];
        if (periodic->axis[k] && !(from >= 0 && from < size))
            place_move(&x[k], left ? &left[k] : NULL, -size * floorf(from / size));
    }
}

/* The shortest of the images of the difference d of two places, m. */
static inline void periodic_nearest(const Periodic *periodic, float d[3])
{
    for (int k = 0; k < 3; k++)
        if (periodic->axis[k])
            d[k] -= periodic->size[k] * rintf(d[k] / periodic->size[k]);
}

#endif
