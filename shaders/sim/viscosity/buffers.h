/* Storage buffer of implicit viscosity, beside shaders/sim/bindings.h: a particle's trial direction, m/s, and
   viscosity. */
#ifndef SLOSH_VISCOSITY_BUFFERS_H
#define SLOSH_VISCOSITY_BUFFERS_H

#include "shaders/sim/bindings.h"

#define TRIALS_BUFFER 3

#endif
