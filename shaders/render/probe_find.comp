// A workgroup per position: combines all parts, and reads the data of the nearest particle.
#include "common/particles.glsl"
#include "common/particle_scalars.glsl"
#include "common/particle_fluids.glsl"
#include "render/probe_fold.glsl"
layout(location = PROBE_GROUPS_AT) uniform uint probe_groups;
layout(location = PROBE_ID_STRIDE_AT) uniform uint probe_id_stride; // 0: no ids
layout(std430, binding = PROBE_IDS_STORAGE) readonly buffer ProbeIds { uint probe_ids[]; };

void main()
{
    uint place = gl_WorkGroupID.x, lane = gl_LocalInvocationID.x;
    Part own = probe_nothing;
    for (uint g = lane; g < probe_groups; g += 64u)
        own = together(own, parts[place * probe_groups + g]);
    own = folded(own);
    if (lane > 0u)
        return;
    answers[place].ratio = own.ratio;
    answers[place].who = own.who;
    answers[place].carried = own.carried;
    answers[place].field = own.field;
    answers[place].lost = own.lost;
    if (own.who == probe_nobody)
        return;
    answers[place].own = vec4(particle_position(own.who), scalar_words[own.who * scalar_stride]);
    answers[place].fluid = fluid_words[own.who * fluid_stride];
    answers[place].id = probe_ids[own.who * probe_id_stride];
}
