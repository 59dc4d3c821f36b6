// The least and greatest coordinates of the particles that count, as integers ordered like the floats.
#include "volume/volume_particle.glsl"
#include "shaders/volume/volume_bindings.h"

layout(local_size_x = 256) in;
layout(std430, binding = BOUNDS_STORAGE) buffer Bounds { uint low[3], high[3]; };

shared vec3 leasts[256], mosts[256];

uint ordered(float value)
{
    uint bits = floatBitsToUint(value);
    return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}

void main()
{
    vec3 least = volume_high, most = volume_low;
    uint lane = gl_LocalInvocationID.x;
    for (uint i = gl_WorkGroupID.x * 256u + lane; i < particle_count; i += 256u * gl_NumWorkGroups.x)
        if (volume_particle(i).height > 0.0) {
            least = min(least, particle_position(i));
            most = max(most, particle_position(i));
        }
    leasts[lane] = least;
    mosts[lane] = most;
    for (uint reach = 128u; reach > 0u; reach >>= 1u) {
        barrier();
        if (lane < reach) {
            leasts[lane] = min(leasts[lane], leasts[lane + reach]);
            mosts[lane] = max(mosts[lane], mosts[lane + reach]);
        }
    }
    if (lane > 0u)
        return;
    for (int k = 0; k < 3; k++) {
        atomicMin(low[k], ordered(leasts[0][k]));
        atomicMax(high[k], ordered(mosts[0][k]));
    }
}
