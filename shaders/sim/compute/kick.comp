// v += (acceleration + gravity) dt, and the greatest of what the sentinel wants to know: bits of floats that are not
// negative are in their order, and those of NaN are above all.
#define WRITES_WATCH
#include "sim/constants.glsl"
#include "shaders/sim/term_block.h"
#include "common/nan.glsl"
#ifdef NO_SLIP
#include "sim/wall_drag.glsl"
layout(std430, binding = NAMES_BUFFER) readonly buffer Names { uvec2 name[]; };
#endif
layout(std430, binding = POSITIONS_BUFFER) readonly buffer Positions { vec4 position[]; }; // w: volume
layout(std430, binding = VELOCITIES_BUFFER) buffer Velocities { vec4 velocity[]; };
layout(std430, binding = ACCELERATIONS_BUFFER) readonly buffer Accelerations { vec4 acceleration[]; };
shared uint greatest[3];

void main()
{
    uint i = invocation();
    if (gl_LocalInvocationID.x < 3u)
        greatest[gl_LocalInvocationID.x] = 0u;
    barrier();
    if (i < particles_there()) { // whatever others of this pass find
        vec3 a = acceleration[i].xyz + gravity;
#ifdef NO_SLIP
        // Drag with the velocity at the end of the step: hold_by_walls in sim/cpu/integrate.c.
        uint fluid = name[i].y;
        float scale = fluids[fluid].viscosity / fluids[fluid].mass * position[i].w / rest_number_density;
        float k = scale * wall_drag_at(position[i].xyz);
#ifdef LID
        a += scale * wall_drag_sum(position[i].xyz, true) * lid_velocity;
#endif
        a = (a - k * velocity[i].xyz) / (1.0 + k * kick_dt);
#endif
        vec3 v = velocity[i].xyz + a * kick_dt;
        velocity[i].xyz = v;
        float fastest = support / kick_dt, speed2 = dot(v, v);
        if (is_nan(speed2) || speed2 > fastest * fastest)
            went_too_far = 1u;
        atomicMax(greatest[0], floatBitsToUint(abs(speed2)));
        atomicMax(greatest[1], floatBitsToUint(abs(dot(a, a))));
        atomicMax(greatest[2], floatBitsToUint(abs(1.0 / (position[i].w * rest_number_density))));
    }
    barrier();
    if (gl_LocalInvocationID.x == 0u) {
        atomicMax(greatest_speed2, greatest[0]);
        atomicMax(greatest_acceleration2, greatest[1]);
        atomicMax(greatest_density_ratio, greatest[2]);
    }
}
