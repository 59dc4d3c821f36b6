// Refraction, reflection and absorption at the surface of a clear fluid, for the shadings water and jelly. Needs
// common/behind.glsl and common/surface.glsl.
#include "shaders/shared/bindings.h"
#include "common/fresnel.glsl"
layout(location = REFRACTION_INDEX_AT) uniform float refraction_index;
layout(location = ATTENUATION_AT) uniform float attenuation; // distance at which white light takes the fluid's colour, m

// Light through the fluid: refracted by Snell's law at entry; leaves after the same length of fluid as the straight ray; absorbed
// by Beer and Lambert's law. After van der Laan et al., Screen space fluid rendering with curvature flow, 2009.
vec3 transmitted(Surface s)
{
    vec3 inner = refract(s.view, s.normal, 1.0 / refraction_index);
    vec3 seen = behind_at(s.place + s.thickness * inner, near_plane / -s.place.z, gl_FragCoord.xy);
    return seen * pow(max(s.albedo, 1e-4), vec3(s.thickness / attenuation));
}

// Suspended matter scatters a little light back, more in thicker fluid: without scattering, deep water would be black.
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

// The cosine to a wall's normal below which the sides of a tank in air reflect rays from inside. Through the top or the next
// side, a side thus shows the tank's floor, and water looks as deep at its edges as elsewhere. The tank's floor on the ground
// reflects nothing. The index used is half as far again above 1 as the fluid's. With the index of water, rays that entered
// through a flat top within some 30 degrees of the wall would leave and end in a fog.
float mirrored_cosine()
{
    float index = 1.0 + 1.54 * max(refraction_index - 1.0, 0.0);
    return sqrt(1.0 - 1.0 / (index * index));
}

// Adds the reflected light to `inside`, the light leaving the surface.
vec3 with_surface(Surface s, vec3 inside)
{
    float share = s.bare * fresnel(max(-dot(s.view, s.normal), 0.0), refraction_index);
    return mix(inside, reflected(s, reflect(s.view, s.normal)), share);
}

// How much of the mirrored sky the rim of a drop has at a depth, m: of a few pixels, the rim would be a white ring around nothing.
float rim_of_drop(float radius, float depth)
{
    return smoothstep(1.0, 6.0, radius * 0.5 * picture_size.y / (view_tangent.y * depth * fineness));
}

// A blended normal may face away from the eye at the rim: bends such normals toward the eye.
vec3 facing(vec3 normal, vec3 view)
{
    return normalize(normal - (max(dot(normal, view), -0.01) + 0.01) * view);
}
