// mueller: accelerations by pressure, viscosity and walls: force_range in sim/mueller/pairs.c, and sim/mueller/passes.c.
#define LISTS_LATER
#include "sim/constants.glsl"
#include "sim/force.glsl"

float volume_of(uint i) { return velocity[i].w; }

float extra_of(uint fluid) { return 0.0; }

vec3 pair_force(Side own, Side other, vec3 d, float r2)
{
    float r = sqrt(r2), t = 1.0 - r * inverse_support;
    vec3 force = pressure_scale * (t * t) * (own.pressure + other.pressure) / r * d;
#ifdef RUBS
    force += 0.5 * viscosity_scale * own.volume * t * other.volume * (own.viscosity + other.viscosity) * (other.v - own.v);
#endif
    return force;
}

#ifdef FELT_SOLIDS
#include "sim/felt_solids.glsl"
#else
#include "sim/walls.glsl"
layout(std430, binding = PRESSURES_BUFFER) readonly buffer Pressures { vec2 pressure[]; }; // p, p V^2

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    vec3 x = near[i].xyz;
    Fluid fluid = fluids[FLUID_OF(i)];
    vec3 force = neighbours_force(i, x, cell_of(x));
    force += wall_force(walls_at(x, false), felt_at(x), fluid.density, volume_of(i), pressure[i].x, near[i].w);
    acceleration[i] = vec4(force / fluid.mass, 0.0);
}
#endif
