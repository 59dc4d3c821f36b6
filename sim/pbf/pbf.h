/* The settings of the method pbf. */
#ifndef SLOSH_PBF_H
#define SLOSH_PBF_H

#include "sim/base/room.h"
#include "sim/world/method.h"

typedef struct IN_A_ROOM PbfDef {
    double tolerance; /* mean compression at which iterations may end, a fraction; 0: all iterations run */
    int iterations;   /* of a step, at most */
} PbfDef;

extern const Method method_pbf;

static inline PbfDef *pbf_def(const WorldDef *def)
{
    return method_def(def, &method_pbf);
}

#endif
