// The colour of each particle's fluid as three numbers, for three sums of a slice. Mixed colours are between the fluids'
// colours; a mean of the fluids' numbers would be a third fluid.
#include "common/frame.glsl"
#include "common/particles.glsl"
#include "common/particle_fluids.glsl"
#include "shaders/slice/slice_bindings.h"

layout(local_size_x = 64) in;
layout(location = CURVE_PARTICLES_AT) uniform uint particles; // number of particles
layout(location = TINTS_APART_AT) uniform uint apart;
layout(std430, binding = SHAPES_STORAGE) writeonly buffer Tints { float tint[]; };

void main()
{
    uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x;
    if (index >= particles)
        return;
    vec3 color = fluid_color[fluid_words[index * fluid_stride] & 7u].rgb;
    for (uint k = 0u; k < 3u; k++)
        tint[k * apart + index] = color[k];
}
