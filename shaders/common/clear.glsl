// Refraction, reflection and absorption at the surface of a clear fluid, for the shadings water and jelly. Wants
// common/behind.glsl and common/surface.glsl.
#include "shaders/shared/bindings.h"
#include "common/fresnel.glsl"
layout(location = REFRACTION_INDEX_AT) uniform float refraction_index;
layout(location = ATTENUATION_AT) uniform float attenuation; // distance through which white light gets the fluid's colour, m

// What comes through the fluid: bent by Snell's law where the ray enters it, seen where it leaves after as much fluid as on the
// straight ray, and weakened by Beer and Lambert's law; van der Laan et al., Screen space fluid rendering with curvature flow, 2009.
vec3 transmitted(Surface s)
{
    vec3 inner = refract(s.view, s.normal, 1.0 / refraction_index);
    vec3 seen = behind_at(s.place + s.thickness * inner, near_plane / -s.place.z, gl_FragCoord.xy);
    return seen * pow(max(s.albedo, 1e-4), vec3(s.thickness / attenuation));
}

// What floats in it scatters a little light back, the more the thicker it is: without that, deep water would be black.
vec3 scattered(Surface s)
{
    float share = 0.4 - 0.4 * exp2(-0.7 * s.thickness / attenuation), up = max(dot(s.normal, light_in_eye), 0.0);
    return share * s.albedo * (ambient_light(s.normal) * (0.35 + 0.65 * s.lit) + light_color * (s.key * (0.3 + 0.7 * up)));
}

vec3 reflected(Surface s, vec3 mirror)
{
    float glint = lobe_32(max(dot(mirror, light_in_eye), 0.0));
    glint *= glint, glint *= glint;
    return environment(s.place, mirror) + 20.0 * s.key * glint * light_color;
}

// The sides of a tank in air mirror rays that come to them from within at a slant: what one sees in a side through the top or through
// the next side is the tank's floor, and water is as deep at its edges as elsewhere. The floor, on which the tank stands, mirrors
// nothing. Up to which cosine to the wall's normal they do: that of an index half as far again above 1 as the fluid's. Water's own lets
// rays out that came in through a flat top within some 30 degrees of it, and they would end in a fog.
float mirrored_cosine()
{
    float index = 1.0 + 1.54 * max(refraction_index - 1.0, 0.0);
    return sqrt(1.0 - 1.0 / (index * index));
}

// Adds to `inside`, what the surface lets out, what it mirrors.
vec3 with_surface(Surface s, vec3 inside)
{
    float share = fresnel(max(-dot(s.view, s.normal), 0.0), refraction_index);
    return mix(inside, reflected(s, reflect(s.view, s.normal)), share);
}

// A normal of a mixture may look away from the eye at the rim: bent until it does not.
vec3 facing(vec3 normal, vec3 view)
{
    return normalize(normal - (max(dot(normal, view), -0.01) + 0.01) * view);
}
