#include "sim/viscosity.h"

const ViscosityKind viscosity_kinds[] = {
    [VISCOSITY_MORRIS] = {"morris",
                          "Morris 1997: along the difference of velocities; for flows without a surface"},
    [VISCOSITY_RADIAL] = {"radial",
                          "after Monaghan and Gingold 1983: along the line between two particles; right at "
                          "free surfaces, keeps angular momentum, half the step"},
    [VISCOSITY_RADIAL + 1] = {0},
};
