// Adds the parts of the forces on box and solids: a group for the box, then one for each solid. A lane takes every 64th
// part. A sum is a number and what rounding left of it, so that the sum of floats is as good as in double.
#include "sim/constants.glsl"
#include "shaders/sim/force_part.h"
layout(std430, binding = FORCES_BUFFER) readonly buffer ForceParts { ForcePart force_parts[]; };
layout(std430, binding = FORCES_RESTS_BUFFER) readonly buffer Rests { vec4 rest[]; }; // x y z, solid
layout(std430, binding = FORCE_SUMS_BUFFER) writeonly buffer ForceSums { ForceSum force_sums[]; };

struct Sum {
    vec3 all, left;
};
shared Sum lane_force[64], lane_torque[64];

// Knuth, The art of computer programming 2, 4.2.2: exact but for `left`.
void add(inout Sum sum, vec3 more, vec3 left)
{
    precise vec3 all = sum.all + more, part = all - sum.all;
    precise vec3 lost = (sum.all - (all - part)) + (more - part) + left;
    sum = Sum(all, sum.left + lost);
}

void main()
{
    uint lane = gl_LocalInvocationID.x, which = invocation() / 64u;
    Sum force = Sum(vec3(0), vec3(0)), torque = force;
    for (uint k = which + lane * FORCES_OF_GROUP; k < FORCES_BOUNDARY; k += 64u * FORCES_OF_GROUP) {
        add(force, force_parts[k].force, vec3(0));
        add(torque, force_parts[k].torque, vec3(0));
    }
    // A force on a boundary particle is taken off the box.
    for (uint b = lane; b < FORCES_BOUNDARY_COUNT; b += 64u) {
        ForcePart part = force_parts[FORCES_BOUNDARY + b];
        if (which == 0u) {
            add(force, -part.force, vec3(0));
            add(torque, -part.about, vec3(0));
        } else if (uint(rest[b].w) == which - 1u) {
            add(force, part.force, vec3(0));
            add(torque, part.torque, vec3(0));
        }
    }
    lane_force[lane] = force;
    lane_torque[lane] = torque;
    for (uint reach = 32u; reach > 0u; reach >>= 1u) {
        barrier();
        if (lane < reach) {
            add(lane_force[lane], lane_force[lane + reach].all, lane_force[lane + reach].left);
            add(lane_torque[lane], lane_torque[lane + reach].all, lane_torque[lane + reach].left);
        }
    }
    if (lane == 0u && which < FORCES_OF_GROUP)
        force_sums[which] = ForceSum(lane_force[0].all, lane_force[0].left, lane_torque[0].all, lane_torque[0].left);
}
