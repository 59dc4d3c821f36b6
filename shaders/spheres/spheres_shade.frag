// Colours the particle that spheres.frag found in the pixel. Where no particle was found, the map is undefined: the depth test
// skips such pixels. With SOLIDS, the depth may be of a solid: there the map holds an invalid index.
#include "common/frame.glsl"
#include "common/light.glsl"
#include "common/particles.glsl"
#include "common/particle_color.glsl"
#include "common/ball.glsl"
#include "shaders/spheres/spheres_bindings.h"
#ifdef SOLIDS
#include "common/solid_light.glsl"
#endif

layout(early_fragment_tests) in;
layout(binding = SEEN_UNIT) uniform usampler2D seen_map;
layout(location = 0) out vec4 color;

// `key`: fraction of the key light that arrives; `lit`: the same without solids.
vec3 shade(vec3 albedo, vec3 normal, vec3 to_eye, float lit, float key)
{
    float to_light = dot(normal, light_in_eye);
    float crevice = 0.45 + 0.55 * max(dot(normal, to_eye), 0.0); // neighbours hide part of the sky near the rim
    float glint = max(dot(2.0 * to_light * normal - light_in_eye, to_eye), 0.0);
    glint *= glint, glint *= glint, glint *= glint, glint *= glint;
    vec3 sky = ambient_light(normal) * (crevice * (0.35 + 0.65 * lit));
    return albedo * sky + light_color * (key * (albedo * max(to_light, 0.0) + 0.10 * glint));
}

// The sphere's normal where the ray hits: u + k ray with u = (w ray - c) / r, w = -c.z and |normal| = 1. No term cancels for
// small and far spheres.
vec3 normal_at(vec3 centre, float radius, vec3 ray, float per_ray2)
{
    vec2 u = (-centre.z * ray.xy - centre.xy) / radius;
    float slant = dot(u, ray.xy) * per_ray2;
    float k = slant + sqrt(max(slant * slant + (1.0 - dot(u, u)) * per_ray2, 0.0));
    return vec3(u - k * ray.xy, k);
}

void main()
{
    uint index = texelFetch(seen_map, ivec2(gl_FragCoord.xy), 0).x;
#ifdef SOLIDS
    if (index == 0xffffffffu)
        discard;
#endif
    Ball ball = ball_of(index);
    vec3 centre = (box_to_eye * vec4(ball.centre, 1.0)).xyz;
    vec3 ray = ray_of_ndc(ndc_of_pixel(gl_FragCoord.xy));
    float per_ray = inversesqrt(dot(ray, ray));
    vec3 normal = normal_at(centre, ball.radius, ray, per_ray * per_ray);
    vec3 albedo = particle_color(index);
    vec3 place = centre + ball.radius * normal;
    float lit = fluid_light(place, gl_FragCoord.xy), key = lit;
#ifdef SOLIDS
    key *= solid_light(place);
#endif
    color = vec4(mix(albedo, shade(albedo, normal, -per_ray * ray, lit, key), shading), 1.0);
}
