// The mean of 4 x 4 texels of what floor_shadow.frag has made: each texel has other places of the disc.
#include "shaders/shared/bindings.h"
layout(binding = FLOOR_LIGHT_UNIT) uniform sampler2D floor_light; // filtered linearly
layout(location = 0) out float light_left;

void main()
{
    vec2 size = vec2(textureSize(floor_light, 0)), middle = gl_FragCoord.xy - 0.5; // of the texels from 2 before to 1 behind
    float sum = 0.0;
    for (int i = 0; i < 4; i++)
        sum += textureLod(floor_light, (middle + vec2(2 * (i & 1) - 1, 2 * (i >> 1) - 1)) / size, 0.0).x;
    light_left = 0.25 * sum;
}
