// What the views want to know of each particle besides place and velocity, and the range of it.
#include "sim/constants.glsl"
#include "common/in_order.glsl"
layout(std430, binding = POSITIONS_BUFFER) readonly buffer Positions { vec4 position[]; }; // w: volume
layout(std430, binding = VELOCITIES_BUFFER) readonly buffer Velocities { vec4 velocity[]; };
layout(std430, binding = NAMES_BUFFER) readonly buffer Names { uvec2 name[]; }; // id, fluid
layout(std430, binding = PRESSURES_BUFFER) readonly buffer Pressures { vec2 pressure[]; };
layout(std430, binding = VALUES_BUFFER) writeonly buffer Values { uint word[]; };
layout(std430, binding = RANGES_BUFFER) buffer Ranges { uint range[]; }; // least and greatest of each scalar, in the order of bits
layout(location = SHOWN_SCALAR_AT) uniform int scalar; // sim/base/scalar.h; SCALAR_STATE_COUNT: the fluid as a number; one more: the id
shared uvec2 ends[64]; // least, greatest

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
    uint i = invocation(), lane = gl_LocalInvocationID.x;
    uvec2 found = uvec2(0xffffffffu, 0u);
    if (i < particle_count()) {
        float value = value_of(i);
        word[i] = scalar == SCALAR_STATE_COUNT ? name[i].y : scalar > SCALAR_STATE_COUNT ? name[i].x : floatBitsToUint(value);
        found = uvec2(in_order(value));
    }
    ends[lane] = found;
    for (uint reach = 32u; reach > 0u; reach >>= 1u) {
        barrier();
        if (lane < reach)
            ends[lane] = uvec2(min(ends[lane].x, ends[lane + reach].x), max(ends[lane].y, ends[lane + reach].y));
    }
    if (lane > 0u || scalar >= SCALAR_STATE_COUNT)
        return;
    // As kick.comp asks.
    if (ends[0].x < range[2 * scalar])
        atomicMin(range[2 * scalar], ends[0].x);
    if (ends[0].y > range[2 * scalar + 1])
        atomicMax(range[2 * scalar + 1], ends[0].y);
}
