/* Settings of the method mueller. */
#ifndef SIM_METHODS_MUELLER_MUELLER_H
#define SIM_METHODS_MUELLER_MUELLER_H

#include "sim/base/base.h"
#include "sim/step/method.h"

typedef struct MAY_ALIAS MuellerDef {
    char density_kernel[NAME_SIZE]; /* see density_kernels in sim/kernel/kernel.h */
    double numerical_viscosity;     /* alpha of the least friction of fluid: step_viscosity */
} MuellerDef;

extern const Method method_mueller;

static inline MuellerDef *mueller_def(const WorldDef *def)
{
    return method_def(def, &method_mueller);
}

#endif
