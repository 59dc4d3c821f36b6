/* Settings of the method wcsph. */
#ifndef SIM_METHODS_WCSPH_WCSPH_H
#define SIM_METHODS_WCSPH_WCSPH_H

#include "sim/base/base.h"
#include "sim/step/method.h"

typedef struct MAY_ALIAS WcsphDef {
    char kernel[NAME_SIZE];      /* see shape_kernels in sim/kernel/kernel.h */
    double artificial_viscosity; /* alpha, for fluids with a viscosity below the equivalent of alpha:
                                    step_alpha */
    int viscosity_form;          /* a ViscosityForm of sim/def/fluids.h */
    double delta_sph;            /* delta of the diffusion of density; 0: none */
    double shifting;             /* chi of particle shifting (sim/methods/wcsph/wcsph_passes.c); 0: none */
    bool corrected_gradient;     /* sim/methods/wcsph/wcsph_passes.c */
} WcsphDef;

extern const Method method_wcsph;

static inline WcsphDef *wcsph_def(const WorldDef *def)
{
    return method_def(def, &method_wcsph);
}

#endif
