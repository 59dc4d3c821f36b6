// The colour of a trail: that of its scalar at the time, the fainter the longer ago.
#include "common/frame.glsl"
#include "common/nan.glsl"
#include "shaders/trails/trails_bindings.h"

layout(binding = COLORMAP_UNIT) uniform sampler2D colormap;
layout(location = TRAIL_TIME_AT) uniform float now;
layout(location = TRAIL_FADE_AT) uniform vec2 fade; // of a second; of what is drawn now
layout(location = TRAIL_IS_FLUID_AT) uniform uint is_fluid;

vec4 trail_color(float time, float value, float covered)
{
    float left = clamp(1.0 - (now - time) * fade.x, 0.0, 1.0), level = (value - range_low) * range_scale;
    vec3 color = edge_color.rgb; // where the scalar is not known
    if (is_fluid != 0u && !is_nan(value))
        color = fluid_color[uint(value + 0.5) & 7u].rgb;
    else if (!is_nan(value))
        color = texelFetch(colormap, ivec2(clamp(level, 0.0, 1.0) * 255.0 + 0.5, 0), 0).rgb;
    return vec4(color, covered * left * fade.y);
}
