// The amount of foam of each particle, in two passes. With RECALL: the rest of the state before. Then, with the inputs of
// derived_foam: the foam of the state, or the rest. See render/water/foam_private.h.
#include "common/particles.glsl"
#include "common/particle_ids.glsl"
#include "water/foam.glsl"
layout(local_size_x = 64) in;

layout(location = FOAM_PARTICLES_AT) uniform uint particles;
layout(location = FOAM_SLOTS_AT) uniform uint slots; // of the table, a power of two
layout(std430, binding = FOAM_AMOUNTS_STORAGE) buffer Amounts { float amounts[]; };
layout(std430, binding = FOAM_TABLE_STORAGE) buffer Table { uint table[]; }; // by slot: id + 1 or 0, bits of the amount

#ifdef RECALL
layout(location = FOAM_LEFT_AT) uniform float left; // share of the past that is left

float past_of(uint key, uint place)
{
    for (uint n = 0u; n < slots; n++) {
        uint at = 2u * (place + n & slots - 1u);
        if (table[at] == key)
            return uintBitsToFloat(table[at + 1u]);
        if (table[at] == 0u)
            break;
    }
    return 0.0;
}

void live(uint i, uint key, uint place)
{
    float amount = left * past_of(key, place);
    amounts[i] = amount > FOAM_LEAST ? amount : 0.0;
}
#else
#include "common/particle_scalars.glsl" // a scalar of two numbers

layout(location = FOAM_SPEEDS_AT) uniform vec4 speeds; // turbulence and speed, m/s: foam starts and is complete
layout(location = FOAM_VELOCITY_STRIDE_AT) uniform uint velocity_stride;
layout(std430, binding = FOAM_VELOCITIES_STORAGE) readonly buffer Velocities { float velocity_words[]; };

// A lookup does not depend on the order of insertion. Amounts are not negative: bits of amounts have the same order.
void keep(uint key, uint place, float amount)
{
    for (uint n = 0u; n < slots; n++) {
        uint at = 2u * (place + n & slots - 1u), was = atomicCompSwap(table[at], 0u, key);
        if (was == 0u || was == key) {
            atomicMax(table[at + 1u], floatBitsToUint(amount));
            break;
        }
    }
}

// Foam under the surface or on a single drop stays, unseen.
void live(uint i, uint key, uint place)
{
    uint at = i * velocity_stride;
    vec3 velocity = vec3(velocity_words[at], velocity_words[at + 1u], velocity_words[at + 2u]);
    vec2 inputs = vec2(scalar_words[i * scalar_stride], scalar_words[i * scalar_stride + 1u]);
    float speed2 = dot(velocity, velocity), old = amounts[i];
    float made = smoothstep(speeds.x, speeds.y, inputs.x) * smoothstep(speeds.z, speeds.w, sqrt(min(speed2, 1e30)));
    bool no_number = is_nan(vec4(particle_position(i), 0.0)) || is_nan(vec4(inputs, speed2, 0.0));
    float amount = no_number ? 0.0 : max(made, old), shown = no_number ? 0.0 : max(made, old * inputs.y);
    amounts[i] = shown > FOAM_LEAST ? shown : 0.0;
    if (id_stride > 0u && amount > FOAM_LEAST)
        keep(key, place, amount);
}
#endif

void main()
{
    uint i = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * 64u + gl_GlobalInvocationID.x;
    if (i < particles)
        live(i, id_of(i) + 1u, id_hash(i));
}
