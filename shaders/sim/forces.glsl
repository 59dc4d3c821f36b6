// Forces on box and solids, if requested (FORCES). Each part has a single writer, so sums are reproducible. First the
// parts of work groups of 64 particles: for the box, then for each solid. Then the parts of boundary particles, from
// FORCES_BOUNDARY on, by number. sim/gpu/compute/solids.c writes the defines.
#include "shaders/sim/bindings.h"
#include "shaders/sim/force_part.h"
layout(std430, binding = FORCES_BUFFER) buffer ForceParts { ForcePart force_parts[]; };

shared vec3 group_force[64], group_torque[64];

// Must be called by the whole group. `which`: 0 for the box, 1 for the first solid.
void forces_add(uint which, vec3 force, vec3 torque)
{
    uint lane = gl_LocalInvocationID.x, i = invocation();
    group_force[lane] = force;
    group_torque[lane] = torque;
    for (uint reach = 32u; reach > 0u; reach >>= 1u) {
        barrier();
        if (lane < reach) {
            group_force[lane] += group_force[lane + reach];
            group_torque[lane] += group_torque[lane + reach];
        }
    }
    if (lane == 0u && i < particles_there()) { // there are more groups than needed for the particles
        uint part = i / 64u * FORCES_OF_GROUP + which;
        force_parts[part].force += group_force[0];
        force_parts[part].torque += group_torque[0];
    }
    barrier();
}
