// wcsph: volume and pressure by the density that particles carry, which stands ready for diffusion:
// state_body in sim/wcsph/density.c.
#include "sim/constants.glsl"
#include "sim/wcsph/wcsph.glsl"
layout(std430, binding = POSITIONS_BUFFER) buffer Positions { vec4 position[]; }; // w: volume
layout(std430, binding = NAMES_BUFFER) readonly buffer Names { uvec2 name[]; };
layout(std430, binding = PRESSURES_BUFFER) writeonly buffer Pressures { vec2 pressure[]; };     // p, p V^2
layout(std430, binding = VELOCITIES_BUFFER) readonly buffer Velocities { vec4 velocity[]; };     // w: rho / rho0 - 1
#ifdef DIFFUSION
layout(std430, binding = SLOPES_BUFFER) buffer Slopes { vec4 slope[]; };
#endif

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    State state = state_of(velocity[i].w, name[i].y);
    position[i].w = state.volume;
    pressure[i] = state.pressure;
#ifdef DIFFUSION
    slope[i].w = velocity[i].w;
#endif
}
