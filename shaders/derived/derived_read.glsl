// What a formula reads of a particle; what it does not read has no block, and is 0. Wants common/particles.glsl.
#include "shaders/derived/derived_bindings.h"
#ifdef VELOCITIES
layout(std430, binding = VELOCITIES_STORAGE) readonly buffer Velocities { float velocity_words[]; };
layout(location = VELOCITY_STRIDE_AT) uniform uint velocity_stride;
vec3 velocity_of(uint i)
{
    uint at = i * velocity_stride;
    return vec3(velocity_words[at], velocity_words[at + 1u], velocity_words[at + 2u]);
}
#else
vec3 velocity_of(uint i) { return vec3(0.0); }
#endif

#ifdef CARRIED
#include "common/particle_scalars.glsl"
float carried_of(uint i) { return scalar_words[i * scalar_stride]; }
#else
float carried_of(uint i) { return 0.0; }
#endif
