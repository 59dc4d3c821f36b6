// Sums for the watch over energy (sim/state.h), added as in gauge.comp.
#include "sim/constants.glsl"
#include "sim/gauge.glsl"
layout(std430, binding = POSITIONS_BUFFER) readonly buffer Positions { vec4 position[]; }; // w: volume, m3
layout(std430, binding = VELOCITIES_BUFFER) readonly buffer Velocities { vec4 velocity[]; };
layout(std430, binding = NAMES_BUFFER) readonly buffer Names { uvec2 name[]; }; // id, fluid
layout(std430, binding = PARTS_BUFFER) writeonly buffer Parts { vec4 part[]; }; // VECTORS a group
layout(location = GRAVITY_C2_AT) uniform vec4 gravity_c2; // w: c^2
const int VECTORS = 6; // energies of motion and compression, mass; m v; m x; m x x: xx, yy, zz; xy, yz, zx; m x cross v
shared vec4 sums[64 * VECTORS];

#ifdef CARRIES_DENSITY
float compression_of(uint i) { return velocity[i].w; }
#else
float compression_of(uint i) { return stiffness_scale * (1.0 / (position[i].w * inverse_unit_volume * rest_number_density) - 1.0); }
#endif

void main()
{
    uint own = gl_LocalInvocationID.x;
    vec4 sum[VECTORS];
    for (int k = 0; k < VECTORS; k++)
        sum[k] = vec4(0.0);
    for (uint i = invocation(); i < particle_count(); i += 64u * gl_NumWorkGroups.x) {
        float m = fluids[name[i].y].mass;
        vec3 x = position[i].xyz, v = velocity[i].xyz;
        vec4 gauge = gauge_of(m, compression_of(i), x, v, vec3(0.0), gravity_c2.w);
        sum[0] += vec4(gauge.y, gauge.w, m, 0.0);
        sum[1].xyz += m * v;
        sum[2].xyz += m * x;
        sum[3].xyz += m * x * x;
        sum[4].xyz += m * x * x.yzx;
        sum[5].xyz += m * cross(x, v);
    }
    for (int k = 0; k < VECTORS; k++)
        sums[own * VECTORS + k] = sum[k];
    for (uint half_count = 32u; half_count > 0u; half_count >>= 1u) {
        barrier();
        for (int k = 0; k < VECTORS && own < half_count; k++)
            sums[own * VECTORS + k] += sums[(own + half_count) * VECTORS + k];
    }
    if (own == 0u)
        for (int k = 0; k < VECTORS; k++)
            part[gl_WorkGroupID.x * VECTORS + k] = sums[k];
}
