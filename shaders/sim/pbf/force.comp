// pbf: accelerations of the whole step, including the way of the iterations: force_body in sim/methods/pbf/pbf_passes.c.
#define LISTS_LATER
#define SEEN_VELOCITY(i) motion[i].xyz
#define FRICTION (min(viscous_dt / dt, 1.0) * friction_gradient) // within the step's stable limit
#include "sim/constants.glsl"
#include "shaders/sim/pbf/pbf_block.h"
layout(std430, binding = MOTIONS_BUFFER) readonly buffer Motions { vec4 motion[]; }; // velocities at the step's end, volume
layout(std430, binding = VELOCITIES_BUFFER) buffer Velocities { vec4 velocity[]; };
layout(location = PASS_DT_AT) uniform float dt;
#ifdef FORCES_ON_SOLIDS
#define FORCES_FORCE(i, term, d, r2) (pair_force(side_of(i, term), boundary_side, d, r2) + by_solid(i, d, r2))
vec3 by_solid(uint i, vec3 d, float r2);
#endif
#include "sim/incompressible/friction.glsl"
#include "sim/incompressible/solids.glsl"
#include "sim/own.glsl"
#include "sim/scratch.glsl"

float volume_of(uint i) { return motion[i].w; }

#ifdef FORCES_ON_SOLIDS
#include "sim/solid_forces.glsl"

vec3 by_solid(uint i, vec3 d, float r2)
{
    vec3 by = vec3(own[OWN_solid_by + i], own[OWN_STRIDE + OWN_solid_by + i], own[2u * OWN_STRIDE + OWN_solid_by + i]);
    float part = solid_part(column_of(SCRATCH_solid_slope, i), d, gradient * shape(sqrt(r2) * inverse_support));
    return fluids[FLUID_OF(i)].mass / (forces_dt * forces_dt) * part * by;
}
#else
layout(std430, binding = PRESSURES_BUFFER) writeonly buffer Pressures { vec2 pressure[]; }; // p, k

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    vec3 moved = vec3(own[OWN_moved + i], own[OWN_STRIDE + OWN_moved + i], own[2u * OWN_STRIDE + OWN_moved + i]);
    float k = own[OWN_term + i], ratio = 1.0 + scratch[SCRATCH_compressed + i];
    acceleration[i] = vec4(other_forces(i) / fluids[FLUID_OF(i)].mass + moved / (dt * dt), 0.0);
    velocity[i] = vec4(velocity[i].xyz - dt * kick_gravity, velocity[i].w);
    pressure[i] = vec2(pressure_of_term * ratio * ratio * k, k);
    if (dt > 0.0) {
        own[OWN_before + i] = ratio;
#ifdef SOLIDS
        own[OWN_boundary_part + i] =
            clamp(scratch[SCRATCH_mirrored + i] / (1.0 + dt * boundary_fades), -BOUNDARY_MOST, BOUNDARY_MOST);
#endif
    }
}
#endif
