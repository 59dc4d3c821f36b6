// Colours of the sums: the fluids', or by the colormap, magenta where most of the fluid is NaN, nothing without fluid.
#include "common/frame.glsl"
#include "common/nan.glsl"
#include "shaders/slice/slice_bindings.h"

#ifdef VEILED
#include "common/curve.glsl"
layout(binding = VEIL_UNIT) uniform sampler2D veils;
#endif
layout(binding = SUMS_UNIT) uniform sampler2D sums;
layout(binding = GREEN_UNIT) uniform sampler2D greens;
layout(binding = BLUE_UNIT) uniform sampler2D blues;
layout(binding = COLORMAP_UNIT) uniform sampler2D colormap;
layout(location = SHOWN_AT) uniform uint shown;
layout(location = CUT_AT) uniform float cut;
layout(location = ISOLINES_AT) uniform uint isolines;
layout(location = OPACITY_AT) uniform float opacity;
layout(location = 0) in vec2 share;
layout(location = 0) out vec4 color;

// The plane's opacity by a scalar; NaN is opaque.
float veil()
{
#ifdef VEILED
    vec4 sum = texture(veils, share);
    return sum.b > sum.g ? 1.0 : curve_at((sum.r / max(sum.g, 1e-30) - scalar_range.x) * scalar_range.y);
#else
    return 1.0;
#endif
}

void main()
{
    vec4 sum = texture(sums, share);
    float field = sum.g + sum.b;
    bool unknown = sum.b > sum.g && shown < SLICE_FIELD;
    float mean = sum.r / max(sum.g, 1e-30);
    float value = shown == SLICE_FIELD ? field : shown == SLICE_RAW ? sum.r : mean;
    float level = (value - range_low) * range_scale * float(isolines + 1u), wide = fwidth(level);
    if (field <= 0.0 || field < cut)
        discard;
    color = texelFetch(colormap, ivec2(clamp((value - range_low) * range_scale, 0.0, 1.0) * 255.0 + 0.5, 0), 0);
    float nearest = round(level);
    bool line = isolines > 0u && nearest > 0.5 && nearest < float(isolines) + 0.5 && abs(level - nearest) < 0.7 * wide && wide < 0.7;
    if (shown == SLICE_TINTS) {
        color.rgb = vec3(sum.r, texture(greens, share).r, texture(blues, share).r) / field;
        line = false;
    }
    color.a = opacity * veil();
#ifdef VEILED
    if (color.a <= 0.0)
        discard;
#endif
    color.rgb = unknown ? no_number_color : line ? color.rgb * 0.15 : color.rgb;
}
