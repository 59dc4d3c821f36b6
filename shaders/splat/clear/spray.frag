// An isolated drop, for render/views/splat/splat_private.h: a lens of fluid. The background is a copy of the picture so far, at the point where
// the ray from the drop leaves the box.
#define FLOOR_SHADOW 1
#include "common/frame.glsl"
#include "common/light.glsl"
#include "shaders/splat/splat_bindings.h"
#ifdef SOLIDS
#include "common/solid_light.glsl"
#endif
#include "common/environment.glsl"
#include "common/behind.glsl"
#include "common/surface.glsl"
#include "common/clear.glsl"
#include "common/within_box.glsl"
#include "common/sphere.glsl"
#include "splat/splat.glsl"
#include "splat/splat_at.glsl"

layout(binding = NEAREST_UNIT) uniform sampler2D nearest_map;
layout(location = SPRAY_BEHIND_AT) uniform uint behind_surface; // 1: only drops behind the fluid's surface
layout(location = 2) flat in vec3 color;
layout(location = 0) out vec4 shown;

// Light through a ball of `radius`. The chord meets the surface at equal angles at both ends, so the ray leaves at the angle of
// entry: light is never trapped in a ball.
vec3 through_ball(Surface s, float radius)
{
    vec3 inner = refract(s.view, s.normal, 1.0 / refraction_index);
    float chord = -2.0 * radius * dot(inner, s.normal);
    vec3 end = s.place + chord * inner, outward = s.normal + chord / radius * inner;
    vec3 outer = refract(inner, -outward, refraction_index);
    outer = dot(outer, outer) > 0.0 ? outer : inner;
    vec3 seen = behind_at(end + way_in_box(end, outer) * outer, near_plane / -s.place.z, gl_FragCoord.xy);
    return seen * pow(max(s.albedo, 1e-4), vec3(chord / attenuation));
}

// The rim reflects at exit as at entry. A drop also focuses the key light on the side away from the light, which darkens the rim,
// most towards the light. Against an even background, this is what makes a drop visible.
vec3 shaded(Surface s, float radius)
{
    vec3 inside = through_ball(s, radius);
#if SHADING == 2
    inside = mix(mix(s.albedo, phong(s), shading), inside, 0.8);
#endif
    float cosine = max(-dot(s.view, s.normal), 0.0), gathered = 1.0 - 0.35 * (1.0 - cosine) * (s.key * dot(s.normal, light_in_eye) + 0.5);
    vec3 left = inside * (gathered * (1.0 - s.bare * fresnel(cosine, refraction_index)));
    return mix(inside, with_surface(s, left), shading);
}

Surface surface_at(Splat hit)
{
    vec3 ray = ray_of_ndc(ndc_of_pixel(gl_FragCoord.xy));
    Surface s = Surface(hit.depth * ray, normalize(ray), hit.normal, color, 0.0, 0.0, 0.0, 1.0);
    s.normal = facing(normalize(hit.normal), s.view);
    s.bare = rim_of_drop(radius, hit.depth);
    s.lit = s.key = fluid_light(s.place, gl_FragCoord.xy);
#ifdef SOLIDS
    s.key *= solid_light(s.place);
#endif
    return s;
}

// The covered fraction of the pixel: a ramp of one pixel at the rim, so that the disc has the right area even if tiny.
float cover_of(Splat hit)
{
    float own = radius * 0.5 * picture_size.y / (view_tangent.y * hit.depth), drawn = own + 0.5;
    float gain = drawn < 1.0 ? 3.0 * own * own / (drawn * drawn * drawn) : own * own / (own * own + 1.0 / 12.0);
    return gain * clamp((1.0 - sqrt(max(1.0 - hit.inside2, 0.0))) * drawn, 0.0, 1.0);
}

void main()
{
    Splat hit = splat_here();
    float surface = abs(texelFetch(nearest_map, ivec2(gl_FragCoord.xy), 0).x); // negative at a wall
    if (!splat_seen(hit) || (behind_surface != 0u && (hit.depth < surface || surface >= 1e29)))
        discard;
    gl_FragDepth = near_plane / hit.depth;
    shown = vec4(shaded(surface_at(hit), radius), cover_of(hit));
}
