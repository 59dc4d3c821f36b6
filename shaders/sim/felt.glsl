// What box and solids feel, where somebody asked for it (FELT): parts that each have one writer, so that sums are the same
// each time. First stand those of the work groups, 64 particles each: of the box, then of each solid; then those of the
// boundary particles, from FELT_BOUNDARY on, by their numbers. sim/gl/compute/forces.c writes the defines.
#include "shaders/sim/bindings.h"
#include "shaders/sim/felt_part.h"
layout(std430, binding = FELT_BUFFER) buffer Felt { FeltPart felt[]; };

shared vec3 felt_force[64], felt_torque[64];

// All of a group call it: `which` is 0 for the box, 1 for the first solid.
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
    if (lane == 0u && i < particles_there()) { // there are more groups than particles need
        uint part = i / 64u * FELT_OF_GROUP + which;
        felt[part].force += felt_force[0];
        felt[part].torque += felt_torque[0];
    }
    barrier();
}
