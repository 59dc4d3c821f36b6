// Marches through the volume from entry to exit, or to a solid: opaque to the surface, WATER beyond the surface, or TRANSLUCENT
// with gathered light. WHOLE: includes the parts left out in a draft. SHOW 1 entry, 2 exit, 3 length, 4 steps, 5 normals show
// inputs instead. MESH: the surface is where triangles were drawn; FACETS: with a normal each, and edges. After: "SPH coupled with volume rendering", SIBGRAPI 2010, section IV.B; Krüger and Westermann 2003; Scharsach
// 2005.
#include "common/frame.glsl"
#include "common/light.glsl"
#include "common/environment.glsl"
#include "common/behind.glsl"
#include "common/surface.glsl"
#include "common/clear.glsl"
#include "common/within_box.glsl"
#include "volume/raycast_ray.glsl"
#ifdef SOLIDS
#include "common/solid_light.glsl"
#endif
#include "volume/raycast_light.glsl"
#include "volume/raycast_surface.glsl"
#ifdef WATER
#include "common/water_line.glsl"
#include "volume/raycast_water.glsl"
#endif
#ifdef TRANSLUCENT
#include "volume/raycast_gather.glsl"
#endif

layout(early_fragment_tests) in;
layout(location = 0) out vec4 color;
layout(location = 1) out float found; // distance of the hit along the eye's axis, m; 0: no hit
#ifdef FACETS
layout(binding = FACETS_UNIT) uniform sampler2D facet_map; // of the mesh: normal, edge

vec4 facet_at(Ray ray)
{
    vec4 facet = texelFetch(facet_map, ivec2(gl_FragCoord.xy), 0);
    return ray.begin > near_start ? facet : vec4(normal_at(ray, ray.begin), 0.0);
}
#endif

#if SHOW == 1 || SHOW == 2 || SHOW == 3
void show(Ray ray)
{
    vec3 at = ray_at(ray, SHOW == 1 ? ray.begin : ray.end);
    float way = (ray.end - ray.begin) * ray.slant;
    color = vec4(SHOW == 3 ? vec3(way / (cell_size * length(volume_cells))) : at, 1.0);
    found = ray.begin;
}
#elif defined TRANSLUCENT && SHOW != 5
void show(Ray ray)
{
    float half_way;
    color = gather(ray, half_way);
#if SHOW == 4
    color = vec4(texelFetch(colormap, ivec2(min(4 * steps, 255), 0), 0).rgb, 1.0);
#endif
    if (color.a <= 0.0)
        discard;
    found = half_way;
}
#else
void show(Ray ray)
{
    float t = find_surface(ray), share;
#if SHOW == 4
    color = vec4(texelFetch(colormap, ivec2(min(4 * steps, 255), 0), 0).rgb, 1.0);
    found = t < 0.0 ? ray.begin : t;
#else
    if (t < 0.0)
        discard;
    found = t;
#ifdef FACETS
    vec4 facet = facet_at(ray);
    vec3 normal = facet.xyz, place = t * ray.to;
#else
    vec3 normal = normal_at(ray, t), place = t * ray.to;
#endif
#if SHOW == 5
    color = vec4(0.5 + 0.5 * normal, 1.0);
#else
    vec3 albedo = albedo_at(ray_at(ray, t), share);
    float lit = lit_at(place);
    Surface surface = Surface(place, ray.to / ray.slant, normal, albedo, lit, key_at(place, lit), 0.0, glass == 2u && t <= ray.wall ? 0.0 : 1.0);
#ifdef WATER
    color = vec4(water(surface), 1.0);
#ifdef WHOLE
    int rounds = glass == 2u && t <= ray.wall ? 1 : 0; // software drivers only skip loops
    for (int i = 0; i < rounds; i++)
        color.rgb = with_water_line(color.rgb, line_share(ray, t, normal));
#endif
#else
    color = vec4(mix(albedo, phong(surface), shading), 1.0);
#endif
#ifdef FACETS
    color.rgb *= 1.0 - 0.6 * facet.w;
#endif
#endif
#endif
}
#endif

void main()
{
    Ray ray = eye_ray();
    // Between glass and a solid on it is no water, but the field goes on there from beside the solid.
    float seam = ray.begin <= ray.wall ? 0.1 * particle_spacing / ray.slant : 0.0;
    if (ray.begin + seam >= ray.end)
        discard;
    show(ray);
}
