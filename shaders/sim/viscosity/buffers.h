/* The storage buffer of implicit viscosity, beside those of shaders/sim/bindings.h: a direction to try, m/s,
   and the viscosity of a particle. */
#ifndef SLOSH_VISCOSITY_BUFFERS_H
#define SLOSH_VISCOSITY_BUFFERS_H

#include "shaders/sim/bindings.h"

#define TRIALS_BUFFER 3

#endif
