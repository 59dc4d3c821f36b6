// The particles, as bound by render/particles/particles.c; strides are in words, since the owner of the buffers chooses the
// strides. Further data is in separate blocks, so that a shader declares only what the shader reads:
// common/particle_scalars.glsl, common/particle_fluids.glsl.
#include "shaders/shared/bindings.h"
layout(std430, binding = POSITIONS_STORAGE) readonly buffer Positions { float position_words[]; };
layout(location = POSITION_STRIDE_AT) uniform uint position_stride;
layout(location = SCALAR_STRIDE_AT) uniform uint scalar_stride;
layout(location = FLUID_STRIDE_AT) uniform uint fluid_stride;

vec3 particle_position(uint particle_index)
{
    uint at = particle_index * position_stride;
    return vec3(position_words[at], position_words[at + 1u], position_words[at + 2u]);
}
