// Lists the foaming particles in order, with their strength, and writes the drawing command of the bubbles: for
// render/water/water.c.
#include "common/frame.glsl"
#include "common/particles.glsl"
#include "common/particle_scalars.glsl"
#include "water/foam.glsl"

layout(location = FOAM_SPEEDS_AT) uniform vec4 speeds; // trapped air and speed, m/s: foam starts and is complete
layout(location = FOAM_VELOCITY_STRIDE_AT) uniform uint velocity_stride;
layout(location = FOAM_MOST_AT) uniform uint most; // limit of bubbles, but at least one per particle
layout(std430, binding = FOAM_VELOCITIES_STORAGE) readonly buffer Velocities { float velocity_words[]; };
layout(std430, binding = FOAM_LIST_STORAGE) writeonly buffer List { uvec2 listed[]; };
layout(std430, binding = FOAM_COMMAND_STORAGE) writeonly buffer Commands { uint command[5]; };

// 0 for NaN.
float foam_of(uint i)
{
    uint at = i * velocity_stride;
    vec3 velocity = vec3(velocity_words[at], velocity_words[at + 1u], velocity_words[at + 2u]);
    float air = scalar_words[i * scalar_stride], speed2 = dot(velocity, velocity);
    if (is_nan(vec4(particle_position(i), air)) || is_nan(speed2))
        return 0.0;
    return smoothstep(speeds.x, speeds.y, air) * smoothstep(speeds.z, speeds.w, sqrt(min(speed2, 1e30)));
}

bool chosen(uint i) { return foam_of(i) > FOAM_LEAST; }

void put(uint to, uint i) { listed[to] = uvec2(i, floatBitsToUint(foam_of(i))); }

void finish(uint total)
{
    uint each_has = clamp(most / max(total, 1u), 1u, FOAM_BUBBLES);
    command = uint[5](each_has * total, 1u, 0u, 0u, each_has);
}

#include "common/select.glsl"
