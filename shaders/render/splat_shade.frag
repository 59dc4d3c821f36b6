// Pass 3, deferred shading of the blended surface. After: Adams et al. 2006, section 3.3. SHOW 1 depth, 2 normals, 3 weight
// show what came before it instead.
#include "common/frame.glsl"
#include "common/light.glsl"
#ifdef SOLIDS
#include "common/solid_light.glsl"
#endif

layout(binding = 1) uniform sampler2D nearest_map;
layout(binding = 5) uniform sampler2D color_map;
layout(binding = 6) uniform sampler2D normal_map;
layout(binding = 7) uniform sampler2D weight_map;
layout(location = 1) uniform vec2 depths; // nearest and farthest of a particle, m
layout(location = 0) out vec4 color;

// `key`: what of the key light arrives; `lit`: the same with no solid in its way. After: Phong, Illumination for computer
// generated pictures, 1975.
vec3 phong(vec3 albedo, vec3 normal, vec3 to_eye, float lit, float key)
{
    float to_light = dot(normal, light_in_eye.xyz);
    float glint = max(dot(2.0 * to_light * normal - light_in_eye.xyz, to_eye), 0.0);
    glint *= glint, glint *= glint, glint *= glint, glint *= glint, glint *= glint;
    vec3 sky = ambient_light(normal) * (0.35 + 0.65 * lit);
    return albedo * sky + light_color.rgb * (key * (albedo * max(to_light, 0.0) + 0.35 * glint));
}

vec3 lit_surface(vec3 ray, float depth, vec3 albedo, vec3 normal)
{
    vec3 place = depth * ray;
    float lit = fluid_light(place), key = lit;
#ifdef SOLIDS
    key *= solid_light(place);
#endif
    return mix(albedo, phong(albedo, normal, -normalize(ray), lit, key), light_in_eye.w);
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(nearest_map, pixel, 0).x, weight = texelFetch(weight_map, pixel, 0).x;
    vec3 normal = texelFetch(normal_map, pixel, 0).xyz;
    float length2 = dot(normal, normal);
    if (!(depth < 1e29 && weight > 0.0 && length2 > 0.0)) // nothing, or just the rim of a lone sphere
        discard;
    gl_FragDepth = lens.z / depth;
    normal *= inversesqrt(length2);
#if SHOW == 1
    color = vec4(vec3(1.0 - 0.9 * clamp((depth - depths.x) / (depths.y - depths.x), 0.0, 1.0)), 1.0);
#elif SHOW == 2
    color = vec4(0.5 + 0.5 * normal, 1.0);
#elif SHOW == 3
    color = vec4(vec3(weight / (1.0 + weight)), 1.0);
#else
    vec3 albedo = texelFetch(color_map, pixel, 0).rgb / weight;
    color = vec4(lit_surface(ray_of_ndc(ndc_of_pixel(gl_FragCoord.xy)), depth, albedo, normal), 1.0);
#endif
}
