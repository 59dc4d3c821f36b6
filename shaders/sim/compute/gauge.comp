// Plotted sums of a state: each invocation adds every 4096th particle, each group its invocations.
#include "sim/constants.glsl"
#include "sim/gauge.glsl"
#include "shaders/sim/gauge_part.h"
layout(std430, binding = POSITIONS_BUFFER) readonly buffer Positions { vec4 position[]; }; // w: volume, m3
layout(std430, binding = VELOCITIES_BUFFER) readonly buffer Velocities { vec4 velocity[]; };
layout(std430, binding = NAMES_BUFFER) readonly buffer Names { uvec2 name[]; }; // id, fluid
layout(std430, binding = PARTS_BUFFER) writeonly buffer Parts { GaugePart part[]; };
layout(location = GRAVITY_C2_AT) uniform vec4 gravity_c2; // in the box's frame; c^2
shared vec4 sums[64];
shared float greatest[64];

#ifdef CARRIES_DENSITY
float compression_of(uint i) { return velocity[i].w; }
#else
float compression_of(uint i) { return stiffness_scale * (1.0 / (position[i].w * inverse_unit_volume * rest_number_density) - 1.0); }
#endif

void main()
{
    uint own = gl_LocalInvocationID.x;
    vec4 sum = vec4(0.0);
    float most = 0.0;
    for (uint i = invocation(); i < particle_count(); i += 64u * gl_NumWorkGroups.x) {
        float compression = compression_of(i);
        sum += gauge_of(fluids[name[i].y].mass, compression, position[i].xyz, velocity[i].xyz, gravity_c2.xyz, gravity_c2.w);
        most = max(most, compression);
    }
    sums[own] = sum;
    greatest[own] = most;
    for (uint half_count = 32u; half_count > 0u; half_count >>= 1u) {
        barrier();
        if (own < half_count) {
            sums[own] += sums[own + half_count];
            greatest[own] = max(greatest[own], greatest[own + half_count]);
        }
    }
    if (own == 0u)
        part[gl_WorkGroupID.x] =
            GaugePart(sums[0].x, sums[0].y, sums[0].z, sums[0].w, greatest[0], float[3](0.0, 0.0, 0.0));
}
