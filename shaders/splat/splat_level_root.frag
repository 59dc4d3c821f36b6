// The root from the field's value and derivatives at a first guess; none if there is no guess.
#include "common/frame.glsl"
#include "shaders/splat/splat_bindings.h"

layout(binding = NEAREST_UNIT) uniform sampler2D start_map;
layout(binding = MARCH_UNIT) uniform sampler2D march_map;
layout(binding = VALUE_UNIT) uniform sampler2D value_map; // value and derivatives
layout(location = SLACK_AT) uniform float slack;          // largest error of the guess, radii
layout(location = LEVEL_AT) uniform float level;          // divided by the gain
layout(location = 0) out float root;

// Newton steps on the cubic with the field's value and derivatives at 0.
float refined(vec4 c)
{
    float t = 0.0;
    for (int i = 0; i < 4; i++) {
        float value = c.x - level + t * (c.y + t * (c.z / 2.0 + t * c.w / 6.0)), slope = c.y + t * (c.z + t * c.w / 2.0);
        t = slope > 0.0 ? clamp(t - value / slope, -slack, slack) : 0.0;
    }
    return t;
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float t = refined(texelFetch(value_map, pixel, 0));
    root = texelFetch(march_map, pixel, 0).w > 0.0 ? texelFetch(start_map, pixel, 0).x + t * particle_radius : 1e30;
}
