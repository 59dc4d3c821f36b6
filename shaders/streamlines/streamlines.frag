// The colour of a line: of the scalar, or plain.
#include "common/frame.glsl"
#include "common/nan.glsl"
#include "shaders/shared/bindings.h"
#include "shaders/streamlines/streamlines_bindings.h"

layout(binding = COLORMAP_UNIT) uniform sampler2D colormap;
layout(location = HALF_WIDTH_AT) uniform float half_width; // pixels
layout(location = STREAM_IS_FLUID_AT) uniform uint is_fluid;
layout(location = STREAM_COLOR_AT) uniform vec4 plain; // alpha 1: all lines have this colour
layout(location = 0) noperspective in float across;
layout(location = 1) in float value;
layout(location = 0) out vec4 color;

vec3 albedo()
{
    float level = clamp((value - range_low) * range_scale, 0.0, 1.0) * 255.0 + 0.5;
    if (plain.a > 0.0)
        return plain.rgb;
    if (is_nan(value))
        return no_number_color;
    return is_fluid != 0u ? fluid_color[uint(value + 0.5) & 7u].rgb : texelFetch(colormap, ivec2(level, 0), 0).rgb;
}

void main()
{
    float covered = clamp(half_width + 0.5 - abs(across), 0.0, 1.0);
    if (covered <= 0.0)
        discard;
    color = vec4(albedo(), covered);
}
