// What the views want to know of each particle besides place and velocity, and the range of it.
#include "sim/constants.glsl"
#include "sim/in_order.glsl"
layout(std430, binding = POSITIONS_BUFFER) readonly buffer Positions { vec4 position[]; }; // w: volume
layout(std430, binding = VELOCITIES_BUFFER) readonly buffer Velocities { vec4 velocity[]; };
layout(std430, binding = NAMES_BUFFER) readonly buffer Names { uvec2 name[]; }; // id, fluid
layout(std430, binding = PRESSURES_BUFFER) readonly buffer Pressures { vec2 pressure[]; };
layout(std430, binding = VALUES_BUFFER) writeonly buffer Values { uint word[]; };
layout(std430, binding = RANGES_BUFFER) buffer Ranges { uint range[]; }; // least and greatest of each scalar, in the order of bits
layout(location = SHOWN_SCALAR_AT) uniform int scalar; // sim/base/scalar.h; SCALAR_COUNT: the fluid as a number; one more: the id
shared uint least, greatest;

#ifdef CARRIES_DENSITY
float compression_of(uint i) { return velocity[i].w; }
#else
float compression_of(uint i) { return stiffness_scale * (1.0 / (position[i].w * rest_number_density) - 1.0); }
#endif

float value_of(uint i)
{
    switch (scalar) {
    case SCALAR_SPEED:
        return length(velocity[i].xyz);
    case SCALAR_DENSITY:
        return fluids[name[i].y].density * (1.0 + compression_of(i));
    case SCALAR_PRESSURE:
        return pressure[i].x;
    case SCALAR_COMPRESSION:
        return compression_of(i);
    case SCALAR_FLUID:
        return float(name[i].y);
    }
    return float(name[i].x);
}

void main()
{
    uint i = invocation();
    if (gl_LocalInvocationID.x == 0u) {
        least = 0xffffffffu;
        greatest = 0u;
    }
    barrier();
    if (i < particle_count()) {
        float value = value_of(i);
        word[i] = scalar == SCALAR_COUNT ? name[i].y : scalar > SCALAR_COUNT ? name[i].x : floatBitsToUint(value);
        atomicMin(least, in_order(value));
        atomicMax(greatest, in_order(value));
    }
    barrier();
    if (gl_LocalInvocationID.x == 0u && scalar < SCALAR_COUNT) {
        atomicMin(range[2 * scalar], least);
        atomicMax(range[2 * scalar + 1], greatest);
    }
}
