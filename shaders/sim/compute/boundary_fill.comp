// Values of boundary particles from the fluid around: Adami, Hu, Adams, "A generalized wall boundary condition for
// smoothed particle hydrodynamics", 2012, eq. 27 and 23; fill_one of sim/cpu/boundary.c.
#include "sim/constants.glsl"
#include "sim/solids.glsl"
#define BOUNDARY_ACCESS
#include "sim/walk.glsl"
layout(std430, binding = POSITIONS_BUFFER) readonly buffer Positions { vec4 position[]; };
layout(std430, binding = NAMES_BUFFER) readonly buffer Names { uvec2 name[]; };
layout(std430, binding = PRESSURES_BUFFER) readonly buffer Pressures { vec2 pressure[]; };
layout(std430, binding = VELOCITIES_BUFFER) readonly buffer Velocities { vec4 velocity[]; };
layout(std430, binding = RESTS_BUFFER) readonly buffer Rests { vec4 rest[]; };

// Weighted sums over the fluid.
vec3 density_x = vec3(0), v = vec3(0);
float weight = 0.0, seen = 0.0, viscosity = 0.0;

void meet(uint j, vec3 d, float volume)
{
    float t = 1.0 - dot(d, d) * inverse_support * inverse_support;
    if (t <= 0.0)
        return;
    Fluid fluid = fluids[name[j].y];
    float w = t * t * t;
    weight += w;
    seen += w * pressure[j].x;
    viscosity += w * fluid.viscosity;
    density_x += w * fluid.density * d;
    v += w * velocity[j].xyz;
}

void main()
{
    uint i = invocation();
    if (i >= boundary_start[cell_count()])
        return;
    vec3 x = boundary_position[i].xyz;
    ivec3 at = cell_of(x);
    WALK_FLUID(x, at, meet)
    uint number = boundary_state[i].y;
    int k = int(rest[number].w);
    float p = 0.0, volume = 1.0 / rest_number_density;
#ifdef HOLDS
    bool sticks = solids[k].sticks != 0 && weight > 0.0;
#else
    bool sticks = false;
#endif
    vec3 wall = solid_velocity_at(k, x);
    if (weight > 0.0) {
        vec3 g = apparent_at(x);
        p = (seen + dot(g - solid_acceleration_at(k, x), density_x)) / weight;
    }
#ifndef NEGATIVE_PRESSURE
    p = max(p, 0.0);
#endif
    boundary_position[i].w = sticks ? volume : 0.0; // 0 for slip: then friction ignores the particle
    boundary_velocity[i] = sticks ? vec4(2.0 * wall - v / weight, viscosity / weight) : vec4(wall, 0.0);
    boundary_state[i].x = floatBitsToUint(p * volume * volume);
}
