/* The settings of the method pbf. */
#ifndef SIM_METHODS_PBF_PBF_H
#define SIM_METHODS_PBF_PBF_H

#include "sim/base/base.h"
#include "sim/step/method.h"

typedef struct MAY_ALIAS PbfDef {
    double tolerance; /* mean compression at which iterations may end, a fraction; 0: all iterations run */
    int iterations;   /* of a step, at most */
} PbfDef;

extern const Method method_pbf;

static inline PbfDef *pbf_def(const WorldDef *def)
{
    return method_def(def, &method_pbf);
}

#endif
