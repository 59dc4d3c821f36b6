/* Pressures of the rows of particles on a floor, or on a plate of a solid from wall to wall. */
#ifndef SLOSH_TEST_DFSPH_ROWS_H
#define SLOSH_TEST_DFSPH_ROWS_H

#include "sim/step/world.h"
#include "tests/sim/fixture.h"

enum { ROWS = 15 };

/* Adds to `pressure` and `weight`, Pa, a particle's share of its row, with `deep` m of fluid above `floor` m.
 */
static inline void add_rows(World *world, double floor, double deep, double pressure[ROWS],
                            double weight[ROWS])
{
    State s = fixture_read(world);
    for (size_t i = 0; i < s.count; i++) {
        const double y = (double)s.position[4 * i + 1] - floor;
        const int row = (int)(y / world->def.spacing);
        if (row < ROWS) {
            pressure[row] += (double)s.pressure[i];
            weight[row] += 9810 * (deep - y);
        }
    }
    fixture_free(&s);
}

/* Lifts the fluid by a plate from wall to wall, thicker than the support; its top, m. */
static inline double put_on_plate(WorldDef *def)
{
    const double thick = 4 * def->spacing, *size = def->box_size;
    def->box_size[1] += thick;
    Fill *fill = (Fill *)&def->fluids[0].fills[0];
    fill->min[1] += thick;
    fill->max[1] += thick;
    def->solids[def->solid_count++] = (SolidDef){.kind = SOLID_BOX,
                                                 .centre = {0, 0.5 * thick, 0},
                                                 .size = {size[0], thick, size[2]},
                                                 .axis = {0, 1, 0}};
    return thick;
}

#endif
