// Forces of a pass on boundary particles of solids, opposite to the forces on the fluid: add_boundary of
// sim/cpu/forces.c. Replaces the main of the pass's shader if FELT_SOLIDS is defined. The shader must declare
// PLACES[] and the walks, and define FELT_FORCE(i, term, d, r2): the force of boundary particle `felt_by` on particle
// i, N, at distance vector d; `term` is the fourth number of i's place.
#include "sim/solids.glsl"
#include "sim/felt.glsl"
layout(std430, binding = FELT_RESTS_BUFFER) readonly buffer Rests { vec4 rest[]; };
layout(location = FELT_DT_AT) uniform float felt_dt;

vec3 felt_sum = vec3(0);

void felt_meet(uint i, vec3 from_fluid, float term)
{
    vec3 d = -from_fluid;
    float r2 = dot(d, d);
    if (r2 < support * support && r2 >= 1e-12 * support * support)
        felt_sum += FELT_FORCE(i, term, d, r2);
}

void main()
{
    felt_by = invocation();
    if (felt_by >= boundary_start[cell_count()])
        return;
    vec3 x = boundary_position[felt_by].xyz;
    ivec3 at = cell_of(x);
    FELT_BEGIN
    WALK_FLUID(x, at, felt_meet)
    uint number = boundary_state[felt_by].y, part = FELT_BOUNDARY + number;
    vec3 force = -felt_dt * felt_sum;
    felt[part].force += force;
    felt[part].torque += cross(x - solids[int(rest[number].w)].end.x, force);
    felt[part].about += cross(x, force);
}
