// Pass 2 at a level above zero: sums of colours, of the field's gradient and of the field itself at the root (eq. 2 and 4).
#include "common/frame.glsl"
#include "common/sphere.glsl"
#include "splat/splat.glsl"
#include "splat/splat_at.glsl"
#include "splat/splat_level.glsl"
#include "shaders/splat/splat_bindings.h"

layout(binding = NEAREST_UNIT) uniform sampler2D nearest_map;
layout(location = KERNEL_GAIN_AT) uniform float gain; // kernel times a particle's volume: V W(0)
layout(location = 2) flat in vec3 color;
layout(early_fragment_tests) in;
layout(location = 0) out vec4 color_sum;
layout(location = 1) out vec4 normal_sum;
layout(location = 2) out float weight_sum;

void main()
{
    vec3 offset = splat_offset(splat_at(), scale, texelFetch(nearest_map, ivec2(gl_FragCoord.xy), 0).x);
    float a = 1.0 - dot(offset, offset);
    if (a <= 0.0 || !splat_adds(splat_chord(splat_at(), scale)))
        discard;
    float slope = gain * a * a;
    weight_sum = slope * a;
    color_sum = vec4(weight_sum * color, 0.0);
    normal_sum = vec4(6.0 * slope * offset, 0.0); // -dW/dr per radius: out of the fluid
}
