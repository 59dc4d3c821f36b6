// wcsph: density from its rate, volume and pressure; data read of neighbours by forces; data for diffusion:
// state_body in sim/methods/wcsph/wcsph_passes.c.
#ifndef SOLIDS
#define OWN_ACCESS readonly
#endif
#include "sim/constants.glsl"
#include "sim/own.glsl"
#include "sim/wcsph/wcsph.glsl"
layout(std430, binding = POSITIONS_BUFFER) buffer Positions { vec4 position[]; }; // w: volume, m3
layout(std430, binding = NAMES_BUFFER) readonly buffer Names { uvec2 name[]; };
layout(std430, binding = PRESSURES_BUFFER) writeonly buffer Pressures { vec2 pressure[]; };     // p, p V^2
layout(std430, binding = VELOCITIES_BUFFER) buffer Velocities { vec4 velocity[]; };              // w: rho / rho0 - 1
layout(std430, binding = NEAR_BUFFER) writeonly buffer Near { vec4 near[]; };                   // x y z, p V^2, for the forces
#ifdef DIFFUSION
layout(std430, binding = SLOPES_BUFFER) buffer Slopes { vec4 slope[]; };
#endif
layout(location = PASS_DT_AT) uniform float dt;

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    float before = velocity[i].w, e = density_after(before, own[OWN_rate + i] * dt);
    float more = 0.0;
#ifdef SOLIDS
    more = boundary_part_after(own[OWN_boundary_part + i], own[OWN_boundary_rate + i], dt);
    own[OWN_boundary_part + i] = more;
#endif
    State state = state_of(e, more, name[i].y);
    velocity[i].w = e;
    position[i].w = unit_volume * state.volume;
    pressure[i] = state.pressure;
    near[i] = vec4(position[i].xyz, state.pressure.y);
#ifdef DIFFUSION
    slope[i].w = 0.5 * (before + e) + more;
#endif
}
