// The root from the field's value and derivatives at a first guess; none where none was found.
#include "common/frame.glsl"

layout(binding = 1) uniform sampler2D start_map;
layout(binding = 3) uniform sampler2D march_map;
layout(binding = 5) uniform sampler2D value_map; // value and derivatives
layout(location = 1) uniform vec2 field;         // radii that it may be off; the level over the gain
layout(location = 0) out float root;

// Newton's steps on the cubic that has the field's value and derivatives at 0.
float refined(vec4 c)
{
    float t = 0.0;
    for (int i = 0; i < 4; i++) {
        float value = c.x - field.y + t * (c.y + t * (c.z / 2.0 + t * c.w / 6.0)), slope = c.y + t * (c.z + t * c.w / 2.0);
        t = slope > 0.0 ? clamp(t - value / slope, -field.x, field.x) : 0.0;
    }
    return t;
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float t = refined(texelFetch(value_map, pixel, 0));
    root = texelFetch(march_map, pixel, 0).w > 0.0 ? texelFetch(start_map, pixel, 0).x + t * particle_radius : 1e30;
}
