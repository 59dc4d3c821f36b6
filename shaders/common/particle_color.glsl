// The colour of a particle: its fluid's, or its scalar's in the colormap; linear light. Wants common/frame.glsl and
// common/particles.glsl.
#include "common/particle_scalars.glsl"
#include "common/particle_fluids.glsl"
layout(binding = 2) uniform sampler2D colormap;

vec3 particle_color(uint index)
{
    if (by_fluid != 0u)
        return fluid_color[fluid_words[index * particle_strides.z] & 7u].rgb;
    float value = (scalar_words[index * particle_strides.y] - range_low) * range_scale;
    return texelFetch(colormap, ivec2(clamp(value, 0.0, 1.0) * 255.0 + 0.5, 0), 0).rgb;
}
