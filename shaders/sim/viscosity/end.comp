// Implicit viscosity: accelerations from the change of velocity: end_body in sim/methods/shared/viscosity.c.
#include "sim/constants.glsl"
#include "sim/scratch.glsl"
#define OWN_ACCESS writeonly
#include "sim/own.glsl"
#include "sim/viscosity/columns.glsl"
layout(std430, binding = NAMES_BUFFER) readonly buffer Names { uvec2 name[]; };
layout(std430, binding = ACCELERATIONS_BUFFER) buffer Accelerations { vec4 acceleration[]; };
layout(location = PASS_DT_AT) uniform float dt;

void main()
{
    uint i = invocation();
    if (i >= particle_count() || dt <= 0.0)
        return;
    vec3 a = column_of(SCRATCH_viscosity_velocity_change, i) / dt, friction = a - (acceleration[i].xyz + kick_gravity);
    vec3 left = dt / fluids[FLUID_OF(i)].mass * column_of(SCRATCH_viscosity_residual, i);
    for (uint k = 0u; k < 3u; k++) {
        own[OWN_viscosity_friction_before + k * OWN_STRIDE + i] = friction[k];
        own[OWN_viscosity_friction_left + k * OWN_STRIDE + i] = left[k];
    }
    acceleration[i].xyz = a - kick_gravity;
}
