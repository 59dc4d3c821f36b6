// The particle data of a formula; unused data has no block, and is 0. Needs common/particles.glsl.
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

#ifdef THREES // components of a vector, each a buffer of floats without gaps
layout(std430, binding = THREES_STORAGE) readonly buffer ThreesX { float three_x[]; };
layout(std430, binding = THREES_STORAGE + 1) readonly buffer ThreesY { float three_y[]; };
layout(std430, binding = THREES_STORAGE + 2) readonly buffer ThreesZ { float three_z[]; };
vec3 three_of(uint i) { return vec3(three_x[i], three_y[i], three_z[i]); }
#else
vec3 three_of(uint i) { return vec3(0.0); }
#endif

#ifdef CARRIED
#include "common/particle_scalars.glsl"
float carried_of(uint i) { return scalar_words[i * scalar_stride]; }
#else
float carried_of(uint i) { return 0.0; }
#endif

#ifdef BIRTHS // the births of sim/state.h, found by the id
layout(std430, binding = IDS_STORAGE) readonly buffer Ids { uint id_words[]; };
layout(std430, binding = BIRTHS_STORAGE) readonly buffer Births { uvec4 births[]; }; // first id, upper half of the id, time
layout(location = BIRTHS_COUNT_AT) uniform uint births_count;
float born_of(uint i)
{
    uint low = 0u, high = births_count;
    while (low < high) {
        uint middle = low + (high - low) / 2u;
        if (births[middle].x <= id_words[i])
            low = middle + 1u;
        else
            high = middle;
    }
    return low > 0u ? uintBitsToFloat(births[low - 1u].z) : 0.0;
}
#endif
