// Soft daylight: a key light with shadow, sky above, ground below.
#include "shaders/shared/bindings.h"
layout(binding = SHADOW_UNIT) uniform sampler2D shadow_map; // reversed: 1 next to the light; 0 without casters

// The map's four texels around a place, in textureGather's order, and the place between them. Gathering at a corner of texels
// makes the four unambiguous.
vec4 texels_around(vec2 at, out vec2 part)
{
    vec2 size = vec2(textureSize(shadow_map, 0)), texel = at * size - 0.5, corner = floor(texel);
    part = texel - corner;
    return textureGather(shadow_map, (corner + 1.0) / size);
}

float between_texels(vec4 around, vec2 part)
{
    vec2 sides = mix(around.wx, around.zy, part.x);
    return mix(sides.x, sides.y, part.y);
}

// A linear filter of the map: some hardware filters no depths without comparison.
float nearest_to_light(vec2 at)
{
    vec2 part;
    vec4 around = texels_around(at, part);
    return between_texels(around, part);
}

// The fraction of the key light at a point inside the fluid: fades with the depth below the first lit surface, as in a cloudy
// liquid. Light is interpolated, not depth: between a drop and a surface far below, depths make a hard edge along the texels.
// After: Reeves, Salesin and Cook, Rendering antialiased shadows with depth maps, 1987.
float fluid_light_at(vec3 at)
{
    vec2 part;
    vec4 below = (texels_around(at.xy, part) - at.z) * light_depth, deep = max(below - shadow_radius, 0.0) / max(shadow_radius, 1e-9);
    return 0.12 + 0.88 * between_texels(exp2(-0.55 * deep), part);
}

// The mean over some texels: rims of one texel are visible on smooth surfaces.
float soft_fluid_light(vec3 at)
{
    const int taps = 4;
    float sum = 0.0, wide = 2.0 / float(textureSize(shadow_map, 0).x);
    for (int i = 0; i < taps; i++) { // sunflower pattern: even over the disc
        float angle = 2.39996 * float(i), reach = wide * sqrt((float(i) + 0.5) / float(taps));
        sum += fluid_light_at(at + vec3(reach * cos(angle), reach * sin(angle), 0.0));
    }
    return sum / float(taps);
}

// At a place in a fragment shader. The four samples of a pixel read the map at places around, for a soft mean.
float fluid_light(vec3 in_eye, vec2 pixel)
{
    vec2 corner = 2.0 * mod(floor(pixel), 2.0) - 1.0;
    vec3 at = (eye_to_light * vec4(in_eye, 1.0)).xyz;
    return fluid_light_at(at + vec3(shadow_spread * (0.9 * corner + vec2(-0.4, 0.4) * corner.yx), 0.0));
}

vec3 ambient_light(vec3 normal)
{
    return mix(ground_color, sky_color, 0.5 + 0.5 * dot(normal, up_in_eye));
}
