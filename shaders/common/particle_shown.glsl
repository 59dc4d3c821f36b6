// The quantity that colours the particles, in one block: bits of a scalar, or the number of a fluid. Returned as a number.
#include "shaders/shared/bindings.h"
layout(std430, binding = SHOWN_STORAGE) readonly buffer Shown { uint shown_words[]; };
layout(location = SHOWN_STRIDE_AT) uniform uint shown_stride;
layout(location = SHOWN_IS_FLUID_AT) uniform uint shown_is_fluid;

float particle_shown(uint index)
{
    uint word = shown_words[index * shown_stride];
    return shown_is_fluid != 0u ? float(word) : uintBitsToFloat(word);
}
