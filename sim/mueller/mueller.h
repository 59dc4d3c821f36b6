/* Settings of the method mueller. */
#ifndef SLOSH_MUELLER_H
#define SLOSH_MUELLER_H

#include "sim/base/room.h"
#include "sim/world/method.h"

typedef struct IN_A_ROOM MuellerDef {
    char density_kernel[NAME_SIZE]; /* see density_kernels in sim/kernel/kernel.h */
    double numerical_viscosity;     /* alpha of the least friction of fluid: step_viscosity */
} MuellerDef;

extern const Method method_mueller;

static inline MuellerDef *mueller_def(const WorldDef *def)
{
    return method_def(def, &method_mueller);
}

/* Warns about settings that fail under mueller. */
void mueller_advise(const MethodAdvice *advice);

#endif
