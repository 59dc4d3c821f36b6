// Values of each particle for the views besides position and velocity.
#include "sim/constants.glsl"
layout(std430, binding = POSITIONS_BUFFER) readonly buffer Positions { vec4 position[]; }; // w: volume, m3
layout(std430, binding = VELOCITIES_BUFFER) readonly buffer Velocities { vec4 velocity[]; };
layout(std430, binding = NAMES_BUFFER) readonly buffer Names { uvec2 name[]; }; // id, fluid
layout(std430, binding = PRESSURES_BUFFER) readonly buffer Pressures { vec2 pressure[]; };
layout(std430, binding = VALUES_BUFFER) writeonly buffer Values { uint word[]; };
layout(location = SHOWN_SCALAR_AT) uniform int scalar; // sim/world.h; SCALAR_STATE_COUNT: fluid as a number; then the id

#ifdef CARRIES_DENSITY
float compression_of(uint i) { return velocity[i].w; }
#else
float compression_of(uint i) { return stiffness_scale * (1.0 / (position[i].w * inverse_unit_volume * rest_number_density) - 1.0); }
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
    if (i >= particle_count())
        return;
    word[i] = scalar == SCALAR_STATE_COUNT  ? name[i].y
              : scalar > SCALAR_STATE_COUNT ? name[i].x
                                            : floatBitsToUint(value_of(i));
}
