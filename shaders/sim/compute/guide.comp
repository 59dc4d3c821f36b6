// Holds fluid of emitters to its course: guide_holds of sim/flow/flow.h.
#include "sim/constants.glsl"
#include "sim/cells.glsl"
#include "shaders/sim/flow_block.h"
layout(std430, binding = POSITIONS_BUFFER) readonly buffer Positions { vec4 position[]; };
layout(std430, binding = NAMES_BUFFER) readonly buffer Names { uvec2 name[]; };
layout(std430, binding = VELOCITIES_BUFFER) buffer Velocities { vec4 velocity[]; };

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    for (int k = 0; k < guide_total; k++) {
        Course guide = guides[k];
        vec3 d = nearest(position[i].xyz - guide.centre);
        float along = dot(d, guide.direction), across2 = dot(d, d) - along * along;
        if (name[i].y == uint(guide.fluid) && along >= 0.0 && along < guide.depth &&
            across2 < guide.radius * guide.radius)
            velocity[i].xyz = guide.velocity;
    }
}
