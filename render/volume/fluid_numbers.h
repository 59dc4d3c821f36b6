/* The particles' fluids as a scalar, for volumes that carry one: its mean between two fluids that follow each
   other in the list is how they mix. Owns a float a particle. */
#ifndef SLOSH_FLUID_NUMBERS_H
#define SLOSH_FLUID_NUMBERS_H

#include "sim/base/error.h"
#include "sim/gl/particle_buffers.h"

typedef struct FluidNumbers {
    unsigned program, buffer;
    size_t capacity; /* particles */
} FluidNumbers;

/* False when the shader does not compile; fluid_numbers_destroy is needed in either case. */
bool fluid_numbers_create(FluidNumbers *numbers, Error *error);
void fluid_numbers_destroy(FluidNumbers *numbers);

/* The same particles with the scalar `fluid`, where their fluid is known. */
ParticleBuffers fluid_numbers_add(FluidNumbers *numbers, const ParticleBuffers *particles);

#endif
