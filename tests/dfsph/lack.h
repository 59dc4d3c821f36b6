/* What the solvers of dfsph add to n at a surface, in double precision. */
#ifndef SLOSH_TEST_DFSPH_LACK_H
#define SLOSH_TEST_DFSPH_LACK_H

#include "sim/methods/dfsph/dfsph_private.h"
#include "sim/step/world.h"

#include <math.h>

/* What a surface lacks of n / n0, by the sum of -grad W there, W with unit integral, and by n / n0. */
static inline double lack_at(const World *world, const double slope[3], double full)
{
    const Constants *c = &world->constants;
    const DfsphBlock *block = dfsph_constants(c);
    const double scaled = hypot(hypot(slope[0], slope[1]), slope[2]) * c->lattice.density_scale *
                          c->unit_volume / (double)block->surface_slope;
    return fmin(fmax((scaled - SURFACE_FROM) / (1 - SURFACE_FROM), 0), 1) *
           fmin(fmax(LACK_OVER_GAP * (1 - full), 0), (double)block->surface_lack);
}

#endif
