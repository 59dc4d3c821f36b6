// Colours the particle that spheres.frag found in this pixel.
#include "common/frame.glsl"
#include "common/light.glsl"
#include "common/particles.glsl"
#include "common/sphere.glsl"

layout(binding = 1) uniform usampler2D seen_map;
layout(binding = 2) uniform sampler2D colormap;
layout(location = 0) out vec4 color;

vec3 particle_color(uint index)
{
    if (coloring.z > 0.5)
        return fluid_color[fluid_words[index * particle_strides.z] & 7u].rgb;
    float value = (scalar_words[index * particle_strides.y] - coloring.x) * coloring.y;
    return texelFetch(colormap, ivec2(clamp(value, 0.0, 1.0) * 255.0 + 0.5, 0), 0).rgb;
}

vec3 shade(vec3 albedo, vec3 normal, vec3 to_eye, float lit)
{
    float to_light = dot(normal, light_in_eye.xyz);
    float crevice = 0.45 + 0.55 * max(dot(normal, to_eye), 0.0); // what neighbours take of the sky near the rim
    float glint = max(dot(2.0 * to_light * normal - light_in_eye.xyz, to_eye), 0.0);
    glint *= glint, glint *= glint, glint *= glint, glint *= glint;
    vec3 sky = ambient_light(normal) * (crevice * (0.35 + 0.65 * lit));
    return albedo * sky + light_color.rgb * (lit * (albedo * max(to_light, 0.0) + 0.10 * glint));
}

void main()
{
    uint seen = texelFetch(seen_map, ivec2(gl_FragCoord.xy), 0).x;
    if (seen == 0u)
        discard;
    Sphere sphere = sphere_at((box_to_eye * vec4(particle_position(seen - 1u), 1.0)).xyz, particle.x);
    vec3 ray = ray_of_ndc(ndc_of_pixel(gl_FragCoord.xy));
    float e, depth = sphere_depth(sphere_offset(sphere, ray), sphere_constants(sphere), e);
    vec3 hit = ray * (lens.z / depth);
    vec3 normal = (hit - sphere.centre) / sphere.radius;
    vec3 albedo = particle_color(seen - 1u);
    color = vec4(mix(albedo, shade(albedo, normal, -normalize(hit), fluid_light(hit)), light_in_eye.w), 1.0);
}
