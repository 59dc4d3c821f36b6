// The colour of a trail: by the scalar at that time, magenta for NaN, fading with age.
#include "common/frame.glsl"
#include "common/nan.glsl"
#include "shaders/trails/trails_bindings.h"

layout(binding = COLORMAP_UNIT) uniform sampler2D colormap;
layout(location = TRAIL_TIME_AT) uniform float now;
layout(location = TRAIL_FADE_AT) uniform vec2 fade; // fading per second; strength in this pass
layout(location = TRAIL_IS_FLUID_AT) uniform uint is_fluid;

// Negative `covered`: the recorded scalar is not the scalar shown.
vec4 trail_color(float time, float value, float covered)
{
    float left = clamp(1.0 - (now - time) * fade.x, 0.0, 1.0), level = (value - range_low) * range_scale;
    vec3 color = no_number_color;
    if (covered < 0.0)
        color = edge_color.rgb;
    else if (!is_nan(value) && is_fluid != 0u)
        color = fluid_color[uint(value + 0.5) & 7u].rgb;
    else if (!is_nan(value))
        color = texelFetch(colormap, ivec2(clamp(level, 0.0, 1.0) * 255.0 + 0.5, 0), 0).rgb;
    return vec4(color, abs(covered) * left * fade.y);
}
