// A row of workgroups per position. DROPS: a radius per ball.
#include "common/frame.glsl"
#include "common/particles.glsl"
#include "common/particle_scalars.glsl"
#include "common/nan.glsl"
#include "common/ball.glsl"
#include "common/plane_kernel.glsl"
#include "render/probe_fold.glsl"
layout(location = PROBE_PARTICLES_AT) uniform uint probe_particles;
layout(location = PROBE_REACH_AT) uniform float probe_reach; // radius of the kernel, m

Part part_of(uint index, vec3 place)
{
    Ball ball = ball_of(index);
    float away = distance(ball.centre, place), volume = position_words[index * position_stride + 3u];
    Part part = probe_nothing;
    if (is_nan(away))
        return part;
    if (ball.radius > 0.0)
        part.ratio = away / ball.radius, part.who = index;
    if (away < probe_reach && volume > 0.0) {
        float share = volume * plane_shape(away / probe_reach), value = scalar_words[index * scalar_stride];
        if (is_nan(value))
            part.lost = share;
        else
            part.field = share, part.carried = share * value;
    }
    return part;
}

void main()
{
    vec4 place = answers[gl_WorkGroupID.y].place;
    Part own = probe_nothing;
    uint first = gl_WorkGroupID.x * 64u * PROBE_LANE + gl_LocalInvocationID.x;
    for (uint k = 0u; k < PROBE_LANE && place.w > 0.0; k++)
        if (first + 64u * k < probe_particles)
            own = together(own, part_of(first + 64u * k, place.xyz));
    own = folded(own);
    if (gl_LocalInvocationID.x == 0u)
        parts[gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x] = own;
}
