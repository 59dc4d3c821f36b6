// What emitters hold to its course: guide_holds of sim/matter/flow.h.
#include "sim/constants.glsl"
#include "sim/cells.glsl"
#include "sim/flow.glsl"
layout(std430, binding = 0) readonly buffer Positions { vec4 position[]; };
layout(std430, binding = 1) readonly buffer Names { uvec2 name[]; };
layout(std430, binding = 2) buffer Velocities { vec4 velocity[]; };

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    for (int k = 0; k < flow_counts.y; k++) {
        Guide guide = guides[k];
        vec3 d = nearest(position[i].xyz - guide.centre.xyz);
        float along = dot(d, guide.direction.xyz), across2 = dot(d, d) - along * along;
        if (name[i].y == uint(guide.velocity.w) && along >= 0.0 && along < guide.direction.w &&
            across2 < guide.centre.w * guide.centre.w)
            velocity[i].xyz = guide.velocity.xyz;
    }
}
