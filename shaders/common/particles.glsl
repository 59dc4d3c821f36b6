// The particles, as bound by render/particles/particles.c; strides are in words, since the owner of the buffers chooses the
// strides. Further data is in separate blocks, so that a shader declares only what the shader reads:
// common/particle_scalars.glsl, common/particle_fluids.glsl.
#include "shaders/shared/bindings.h"
layout(std430, binding = POSITIONS_STORAGE) readonly buffer Positions { float position_words[]; };
layout(location = POSITION_STRIDE_AT) uniform uint particle_strides[3]; // and SCALAR_STRIDE_AT, FLUID_STRIDE_AT: set by one call
#define position_stride particle_strides[0]
#define scalar_stride particle_strides[1]
#define fluid_stride particle_strides[2]

vec3 particle_position(uint particle_index)
{
    uint at = particle_index * position_stride;
    return vec3(position_words[at], position_words[at + 1u], position_words[at + 2u]);
}
