// toy: springs that harden with age: body of tests/sim/toy_method.h.
#include "sim/constants.glsl"
#include "sim/own.glsl"
#include "sim/scratch.glsl"
layout(std430, binding = POSITIONS_BUFFER) buffer Positions { vec4 position[]; }; // w: volume
layout(std430, binding = NAMES_BUFFER) readonly buffer Names { uvec2 name[]; }; // id, fluid
layout(std430, binding = ACCELERATIONS_BUFFER) writeonly buffer Accelerations { vec4 acceleration[]; };
layout(std140, binding = METHOD_BLOCK) uniform SpringBlock { float springs; }; // Constants.of_method
layout(location = PASS_DT_AT) uniform float dt;

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    own[OWN_age + i] += dt * float(name[i].x);
    scratch[SCRATCH_stiffness + i] = springs + 1000.0 * own[OWN_age + i];
    acceleration[i] = vec4(-scratch[SCRATCH_stiffness + i] * position[i].x, 0.0, 0.0, 0.0);
    position[i].w = 1.0 / rest_number_density;
}
