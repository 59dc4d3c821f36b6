/* The particles' fluids as a scalar, for volumes that carry a scalar: the mean between two fluids that
   follow each other in the list is the mixing ratio. Owns a float per particle. */
#ifndef SLOSH_FLUID_NUMBERS_H
#define SLOSH_FLUID_NUMBERS_H

#include "sim/base/error.h"
#include "sim/gl/particle_buffers.h"

typedef struct FluidNumbers {
    unsigned program, buffer;
    size_t capacity; /* particles */
} FluidNumbers;

/* Returns false if the shader does not compile; call fluid_numbers_destroy in either case. */
bool fluid_numbers_create(FluidNumbers *numbers, Error *error);
void fluid_numbers_destroy(FluidNumbers *numbers);

/* Returns the state with the scalar `fluid`, if the particles' fluids are known. */
ParticleBuffers fluid_numbers_add(FluidNumbers *numbers, const ParticleBuffers *particles);

#endif
