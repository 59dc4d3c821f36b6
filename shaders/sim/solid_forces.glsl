// Forces of a pass on boundary particles of solids, opposite to the forces on the fluid: add_boundary of
// sim/cpu/forces.c. Replaces the main of the pass's shader if FORCES_ON_SOLIDS is defined. The shader must declare
// PLACES[] and the walks, and define FORCES_FORCE(i, term, d, r2): the force of boundary particle `boundary_by` on particle
// i, N, at distance vector d. `term` is the fourth number of i's place. FORCES_IMAGE runs before the images of the
// boundary particle, which push without friction and, for the solid, along their walls alone.
#include "sim/solids.glsl"
#include "sim/forces.glsl"
#include "sim/images.glsl"
layout(std430, binding = FORCES_RESTS_BUFFER) readonly buffer Rests { vec4 rest[]; };
layout(location = FORCES_DT_AT) uniform float forces_dt;

vec3 force_sum = vec3(0);

void add_force(uint i, vec3 from_fluid, float term)
{
    vec3 d = -from_fluid;
    float r2 = dot(d, d);
    if (r2 < support * support && r2 >= 1e-12 * support * support)
        force_sum += FORCES_FORCE(i, term, d, r2);
}

void main()
{
    boundary_by = invocation();
    if (boundary_by >= boundary_start[cell_count()])
        return;
    vec3 x = boundary_position[boundary_by].xyz, force_all;
    ivec3 at = cell_of(x);
    int end = images_end(x);
    Image image;
    FORCES_BEGIN
    WALK_FLUID(x, at, add_force)
    force_all = force_sum;
    FORCES_IMAGE
    for (int walls = 1; walls < end; walls++) {
        if (!image_of(x, walls, image))
            continue;
        force_sum = vec3(0);
        WALK_FLUID(image.x, at, add_force)
        force_all += max(image.sign, 0.0) * force_sum;
    }
    uint number = boundary_state[boundary_by].y, part = FORCES_BOUNDARY + number;
    vec3 force = -forces_dt * force_all;
    force_parts[part].force += force;
    force_parts[part].torque += cross(x - solids[int(rest[number].w)].end.x, force);
    force_parts[part].about += cross(x, force);
}
