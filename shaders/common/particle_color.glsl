// The colour of a particle: of its fluid, or of its scalar in the colormap, magenta for NaN; linear light. Needs
// common/frame.glsl and common/particles.glsl.
#include "shaders/shared/bindings.h"
#include "common/nan.glsl"
#include "common/particle_scalars.glsl"
#include "common/particle_fluids.glsl"
layout(binding = COLORMAP_UNIT) uniform sampler2D colormap;

vec3 particle_color(uint index)
{
    if (by_fluid != 0u)
        return fluid_color[fluid_words[index * fluid_stride] & 7u].rgb;
    float value = (scalar_words[index * scalar_stride] - range_low) * range_scale;
    if (is_nan(value))
        return no_number_color;
    return texelFetch(colormap, ivec2(clamp(value, 0.0, 1.0) * 255.0 + 0.5, 0), 0).rgb;
}
