/* The settings of the method dfsph. */
#ifndef SIM_METHODS_DFSPH_DFSPH_H
#define SIM_METHODS_DFSPH_DFSPH_H

#include "sim/base/base.h"
#include "sim/step/method.h"

typedef struct MAY_ALIAS DfsphDef {
    double tolerance;            /* mean compression left by the solver of density, a fraction */
    double divergence_tolerance; /* mean compression allowed in a step by velocities, a fraction */
    int iterations;              /* of each solver, at most */
    bool coarse;                 /* a coarse level corrects slow iterations of the solver of divergence */
    double surface_lack; /* part of the neighbours that a free surface lacks, added by the solvers; 0: none */
    double rest_viscosity; /* alpha of the least friction of fluid: dfsph_friction */
} DfsphDef;

extern const Method method_dfsph;

static inline DfsphDef *dfsph_def(const WorldDef *def)
{
    return method_def(def, &method_dfsph);
}

#endif
