// Forces on box and solids, if requested (FELT). Each part has a single writer, so sums are reproducible. First the
// parts of work groups of 64 particles: for the box, then for each solid. Then the parts of boundary particles, from
// FELT_BOUNDARY on, by number. sim/gpu/compute/solids.c writes the defines.
#include "shaders/sim/bindings.h"
#include "shaders/sim/felt_part.h"
layout(std430, binding = FELT_BUFFER) buffer Felt { FeltPart felt[]; };

shared vec3 felt_force[64], felt_torque[64];

// Must be called by the whole group. `which`: 0 for the box, 1 for the first solid.
void felt_add(uint which, vec3 force, vec3 torque)
{
    uint lane = gl_LocalInvocationID.x, i = invocation();
    felt_force[lane] = force;
    felt_torque[lane] = torque;
    for (uint reach = 32u; reach > 0u; reach >>= 1u) {
        barrier();
        if (lane < reach) {
            felt_force[lane] += felt_force[lane + reach];
            felt_torque[lane] += felt_torque[lane + reach];
        }
    }
    if (lane == 0u && i < particles_there()) { // there are more groups than needed for the particles
        uint part = i / 64u * FELT_OF_GROUP + which;
        felt[part].force += felt_force[0];
        felt[part].torque += felt_torque[0];
    }
    barrier();
}
