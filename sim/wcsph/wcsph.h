/* Settings of the method wcsph. */
#ifndef SLOSH_WCSPH_H
#define SLOSH_WCSPH_H

#include "sim/base/room.h"
#include "sim/world/method.h"

typedef struct IN_A_ROOM WcsphDef {
    char kernel[NAME_SIZE];      /* see shape_kernels in sim/kernel/kernel.h */
    double artificial_viscosity; /* alpha, for fluids with a viscosity below the equivalent of alpha:
                                    step_alpha */
    int viscosity_form;          /* a ViscosityForm of sim/matter/viscosity.h */
    double delta_sph;            /* delta of the diffusion of density; 0: none */
    double shifting;             /* chi of particle shifting (sim/wcsph/shift.c); 0: none */
    bool corrected_gradient;     /* sim/wcsph/corrected.c */
} WcsphDef;

extern const Method method_wcsph;

static inline WcsphDef *wcsph_def(const WorldDef *def)
{
    return method_def(def, &method_wcsph);
}

/* Warns about mismatched settings under wcsph. */
void wcsph_advise(const MethodAdvice *advice);

#endif
