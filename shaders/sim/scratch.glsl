// Scratch columns of the method (Method.columns: COLUMN_SHADERS), computed in each step: scratch[SCRATCH_stiffness +
// i]. Same layout as own.glsl.
#include "shaders/sim/bindings.h"
layout(std430, binding = SCRATCH_BUFFER) buffer Scratch { float scratch[]; };

// A column of three numbers of scratch, by the place of its first.
vec3 column_of(uint at, uint i)
{
    return vec3(scratch[at + i], scratch[at + OWN_STRIDE + i], scratch[at + 2u * OWN_STRIDE + i]);
}

void column_set(uint at, uint i, vec3 value)
{
    for (uint k = 0u; k < 3u; k++)
        scratch[at + k * OWN_STRIDE + i] = value[k];
}
