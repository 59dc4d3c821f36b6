// The least and greatest coordinates of the particles that count, as numbers whose order is that of the floats. One workgroup.
#include "volume/volume_particle.glsl"
#include "shaders/volume/volume_bindings.h"

layout(local_size_x = 256) in;
layout(std430, binding = BOUNDS_STORAGE) buffer Bounds { uint low[3], high[3]; };

uint ordered(float value)
{
    uint bits = floatBitsToUint(value);
    return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}

void main()
{
    vec3 least = volume_high, most = volume_low;
    for (uint i = gl_LocalInvocationID.x; i < particle_count; i += 256u)
        if (volume_particle(i).height > 0.0) {
            least = min(least, particle_position(i));
            most = max(most, particle_position(i));
        }
    for (int k = 0; k < 3; k++) {
        atomicMin(low[k], ordered(least[k]));
        atomicMax(high[k], ordered(most[k]));
    }
}
