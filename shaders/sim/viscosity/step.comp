// Implicit viscosity: a step along the next direction, then the next trial direction: step_body in sim/methods/shared/viscosity.c.
#include "sim/constants.glsl"
#include "shaders/sim/solve_block.h"
#include "shaders/sim/viscosity/buffers.h"
#include "sim/scratch.glsl"
#include "sim/viscosity/columns.glsl"
layout(std430, binding = NAMES_BUFFER) readonly buffer Names { uvec2 name[]; };
layout(std430, binding = TRIALS_BUFFER) buffer Trials { vec4 trial[]; };
layout(location = PASS_DT_AT) uniform float dt;

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    vec4 z = trial[i];
    vec3 direction = z.xyz + turn * column_of(SCRATCH_viscosity_direction, i);
    vec3 along = column_of(SCRATCH_viscosity_product, i) + turn * column_of(SCRATCH_viscosity_along, i);
    vec3 residual = column_of(SCRATCH_viscosity_residual, i) - go * along;
    column_set(SCRATCH_viscosity_direction, i, direction);
    column_set(SCRATCH_viscosity_along, i, along);
    column_set(SCRATCH_viscosity_velocity_change, i, column_of(SCRATCH_viscosity_velocity_change, i) + go * direction);
    column_set(SCRATCH_viscosity_residual, i, residual);
    vec3 next = times(column_of(SCRATCH_viscosity_inverse, i), column_of(SCRATCH_viscosity_inverse_mixed, i), residual);
    trial[i] = vec4(next, z.w);
    scratch[SCRATCH_viscosity_miss + i] = length(residual) * dt / fluids[FLUID_OF(i)].mass;
}
