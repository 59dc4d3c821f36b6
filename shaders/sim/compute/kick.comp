// v += (acceleration + gravity) dt, and the maxima for the sentinel. Bits of non-negative floats have the order of
// the floats, and the bits of NaN are above all.
#define WRITES_WATCH
#include "sim/constants.glsl"
#include "shaders/sim/term_block.h"
#include "common/nan.glsl"
#if defined NO_SLIP && defined RUBS // otherwise sim/viscosity
#include "sim/wall_drag.glsl"
#define NAMED
#endif
#ifdef FORCES
#include "sim/forces.glsl"
#define NAMED
#endif
#ifdef NAMED
layout(std430, binding = NAMES_BUFFER) readonly buffer Names { uvec2 name[]; };
#endif
layout(std430, binding = POSITIONS_BUFFER) readonly buffer Positions { vec4 position[]; }; // w: volume, m3
layout(std430, binding = VELOCITIES_BUFFER) buffer Velocities { vec4 velocity[]; };
layout(std430, binding = ACCELERATIONS_BUFFER) readonly buffer Accelerations { vec4 acceleration[]; };
shared uvec3 greatest[64];

void main()
{
    uint i = invocation(), lane = gl_LocalInvocationID.x;
    uvec3 found = uvec3(0u);
#ifdef FORCES
    vec3 pushed = vec3(0), turned = vec3(0);
#endif
    if (i < particles_there()) { // independent of findings of the same pass
        vec3 a = acceleration[i].xyz + gravity;
#if defined NO_SLIP && defined RUBS
        // Drag with the velocity at the end of the step: hold_by_walls in sim/cpu/integrate.c.
        uint fluid = name[i].y;
        float scale = fluids[fluid].viscosity / fluids[fluid].mass * (position[i].w * inverse_unit_volume) / rest_number_density;
        float k = scale * wall_drag_at(position[i].xyz);
#ifdef LID
        a += scale * wall_drag_sum(position[i].xyz, true) * lid_velocity;
#endif
        a = (a - k * velocity[i].xyz) / (1.0 + k * kick_dt);
#endif
        vec3 v = velocity[i].xyz + a * kick_dt;
        velocity[i].xyz = v;
#ifdef FORCES
        pushed = -kick_dt * fluids[FLUID_OF(i)].mass * (a - gravity);
        turned = cross(position[i].xyz, pushed);
#endif
#ifdef LEAPS
        float fastest = 1e18; // with a finite square
#else
        float fastest = support / kick_dt;
#endif
        float speed2 = dot(v, v);
        if (is_nan(speed2) || speed2 > fastest * fastest)
            went_too_far = 1u;
        found = floatBitsToUint(abs(vec3(speed2, dot(a, a), 1.0 / (position[i].w * inverse_unit_volume * rest_number_density))));
    }
#ifdef FORCES
    forces_add(0u, pushed, turned);
#endif
    greatest[lane] = found;
    for (uint reach = 32u; reach > 0u; reach >>= 1u) {
        barrier();
        if (lane < reach)
            greatest[lane] = max(greatest[lane], greatest[lane + reach]);
    }
    if (lane > 0u)
        return;
    // Most groups find less than the known maxima. A read may be out of date, which only causes a superfluous
    // atomicMax.
    if (greatest[0].x > greatest_speed2)
        atomicMax(greatest_speed2, greatest[0].x);
    if (greatest[0].y > greatest_acceleration2)
        atomicMax(greatest_acceleration2, greatest[0].y);
    if (greatest[0].z > greatest_density_ratio)
        atomicMax(greatest_density_ratio, greatest[0].z);
}
