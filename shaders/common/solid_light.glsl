// The fraction of the key light that solids let pass: 0 or 1, with a rim of a texel or two. Needs common/frame.glsl.
#include "shaders/shared/bindings.h"
layout(binding = SOLID_SHADOW_UNIT) uniform sampler2DShadow solid_map; // reversed, like shadow_map; holds the sides away from the light

// The size of a texel as a fraction of the map.
float shadow_texel()
{
    return 1.0 / float(textureSize(solid_map, 0).x);
}

float solid_light(vec3 in_eye)
{
    float texel = shadow_texel(), sum = 0.0;
    vec3 at = (eye_to_light * vec4(in_eye, 1.0)).xyz + vec3(0.0, 0.0, 0.5 * texel);
    for (int i = 0; i < 4; i++) {
        vec2 step = vec2(i & 1, i >> 1) - 0.5;
        sum += textureLod(solid_map, at + vec3(1.5 * texel * step, 0.0), 0.0);
    }
    return 0.25 * sum;
}
