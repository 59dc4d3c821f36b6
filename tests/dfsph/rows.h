/* Pressures of the rows of particles on a floor. */
#ifndef SLOSH_TEST_DFSPH_ROWS_H
#define SLOSH_TEST_DFSPH_ROWS_H

#include "sim/step/world.h"
#include "tests/sim/fixture.h"

enum { ROWS = 15 };

/* Adds to `pressure` and `weight`, Pa, a particle's share of its row, with `deep` m of fluid. */
static inline void add_rows(World *world, double deep, double pressure[ROWS], double weight[ROWS])
{
    State s = fixture_read(world);
    for (size_t i = 0; i < s.count; i++) {
        const double y = (double)s.position[4 * i + 1];
        const int row = (int)(y / world->def.spacing);
        if (row < ROWS) {
            pressure[row] += (double)s.pressure[i];
            weight[row] += 9810 * (deep - y);
        }
    }
    fixture_free(&s);
}

#endif
