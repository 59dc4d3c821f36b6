// Soft daylight: a key light with shadow, sky above, ground below.
#include "shaders/shared/bindings.h"
layout(binding = SHADOW_UNIT) uniform sampler2D shadow_map; // reversed: 1 next to the light; 0 without casters

// Interpolates the map's four nearest texels like a linear filter: not all hardware filters depths without comparison.
float nearest_to_light(vec2 at)
{
    vec2 size = vec2(textureSize(shadow_map, 0)), texel = at * size - 0.5, corner = floor(texel), part = texel - corner;
    vec4 around = textureGather(shadow_map, (corner + 1.0) / size); // gathering at a corner of texels makes the four texels unambiguous
    vec2 sides = mix(around.wx, around.zy, part.x);
    return mix(sides.x, sides.y, part.y);
}

// The fraction of the key light at a point inside the fluid: fades with the depth below the first lit surface, as in a cloudy
// liquid. Soft, needs no bias and costs one texel.
float fluid_light_at(vec3 at)
{
    float below = (nearest_to_light(at.xy) - at.z) * light_depth;
    return 0.12 + 0.88 * exp2(-0.55 * max(below - shadow_radius, 0.0) / max(shadow_radius, 1e-9));
}

float fluid_light(vec3 in_eye)
{
    return fluid_light_at((eye_to_light * vec4(in_eye, 1.0)).xyz);
}

vec3 ambient_light(vec3 normal)
{
    return mix(ground_color, sky_color, 0.5 + 0.5 * dot(normal, up_in_eye));
}
