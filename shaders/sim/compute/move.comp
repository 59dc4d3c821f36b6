// Moves particles into the order of their cells; after a step that blew up there is no order, and particles stay.
#include "sim/constants.glsl"
#include "sim/lists.glsl"
layout(std430, binding = ORDERS_BUFFER) readonly buffer Orders { uint order[]; };
layout(std430, binding = OLD_POSITIONS_BUFFER) readonly buffer OldPositions { vec4 old_position[]; };
layout(std430, binding = OLD_VELOCITIES_BUFFER) readonly buffer OldVelocities { vec4 old_velocity[]; };
layout(std430, binding = OLD_NAMES_BUFFER) readonly buffer OldNames { uvec2 old_name[]; };
layout(std430, binding = POSITIONS_BUFFER) writeonly buffer Positions { vec4 position[]; };
layout(std430, binding = VELOCITIES_BUFFER) writeonly buffer Velocities { vec4 velocity[]; };
layout(std430, binding = NAMES_BUFFER) writeonly buffer Names { uvec2 name[]; }; // id, fluid

void main()
{
    uint i = invocation();
    if (i >= particles_there())
        return;
    uint o = particle_count() > 0u ? order[i] : i;
    position[i] = old_position[o];
    velocity[i] = old_velocity[o];
    name[i] = old_name[o];
#ifdef LISTS
    list_put(i, list_own(i), LIST_NONE);
#endif
}
