/* The settings of the method dfsph. */
#ifndef SLOSH_DFSPH_H
#define SLOSH_DFSPH_H

#include "sim/base/room.h"
#include "sim/world/method.h"

typedef struct IN_A_ROOM DfsphDef {
    double tolerance;            /* mean compression left by the solver of density, a fraction */
    double divergence_tolerance; /* mean compression allowed in a step by velocities, a fraction */
    int iterations;              /* of each solver, at most */
} DfsphDef;

extern const Method method_dfsph;

static inline DfsphDef *dfsph_def(const WorldDef *def)
{
    return method_def(def, &method_dfsph);
}

#endif
